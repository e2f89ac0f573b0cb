/** Reports in a browser; FREEBODY_REPORTS is a folder with some, which tests/views/test_front_end.py writes. */

import { readdirSync } from "node:fs";
import { join } from "node:path";
import { type Browser, chromium, type Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

const folder = process.env.FREEBODY_REPORTS ?? "";
const reports = folder ? readdirSync(folder).filter((name) => name.endsWith(".html")) : [];
const DESKTOP = { width: 1280, height: 900 };
const PHONE = { width: 390, height: 844 };

let browser: Browser;
beforeAll(async () => {
  if (folder) browser = await chromium.launch({ executablePath: process.env.FREEBODY_CHROMIUM, args: ["--no-sandbox"] });
});
afterAll(async () => browser?.close());

/** A report, opened; whatever it complains of fails the test. */
async function open(name: string, viewport = DESKTOP, colorScheme: "light" | "dark" = "light"): Promise<Page> {
  const page = await browser.newPage({ viewport, colorScheme });
  page.on("pageerror", (error) => { throw error; });
  page.on("console", (message) => { throw new Error(message.text()); });
  await page.goto(`file://${join(folder, name)}`);
  return page;
}

const clock = (page: Page): Promise<number> =>
  page.locator("output").first().innerText().then((text) => Number(/t = ([\d.]+)/.exec(text)![1]));

async function seek(page: Page, part: number): Promise<void> {
  await page.locator('input[type="range"]').evaluate((bar: HTMLInputElement, value) => {
    bar.value = String(value);
    bar.dispatchEvent(new Event("input", { bubbles: true }));
  }, part);
}

describe.runIf(folder)("every report", () => {
  test.each(reports)("%s shows the mechanism and its plots, whatever the screen", async (name) => {
    for (const [viewport, scheme] of [[DESKTOP, "light"], [PHONE, "dark"]] as const) {
      const page = await open(name, viewport, scheme);
      await seek(page, 0.4);
      expect(await page.locator(".mechanism path.body, .mechanism path.mass, .mechanism path.band").count()).toBeGreaterThan(0);
      expect(await page.locator(".plot svg path.curve").count()).toBeGreaterThan(2);
      expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(viewport.width);
      await page.close();
    }
  });

  test.each(reports)("%s prints in light colours", async (name) => {
    const page = await open(name, DESKTOP, "dark");
    await page.emulateMedia({ media: "print" });
    expect(await page.locator(".card").first().evaluate((card) => getComputedStyle(card).backgroundColor)).toBe("rgb(255, 255, 255)");
    expect(await page.locator("body").evaluate((body) => getComputedStyle(body).backgroundColor)).toBe("rgb(255, 255, 255)");
    for (const control of [".play", ".bar", ".view", ".loads"]) expect(await page.locator(control).isVisible()).toBe(false);
    expect(await page.locator("output").isVisible()).toBe(true);
    const swatch = await page.locator(".swatch.f0").first().evaluate((line) => getComputedStyle(line).borderTopColor);
    expect(swatch).toBe(await page.locator(".curve.s0").first().evaluate((curve) => getComputedStyle(curve).stroke));
    await page.close();
  });
});

describe.runIf(folder)("the four-bar", () => {
  test("space plays and stops, wherever the focus is", async () => {
    const page = await open("four_bar.html");
    await page.locator("select").first().focus();
    await page.keyboard.press("Space");
    await page.waitForTimeout(300);
    await page.keyboard.press("Space");
    const stopped = await clock(page);
    expect(stopped).toBeGreaterThan(0.1);
    await page.waitForTimeout(100);
    expect(await clock(page)).toBe(stopped);
    await page.close();
  });

  test("arrows step by a frame, with Shift to the next event", async () => {
    const page = await open("four_bar.html");
    await page.locator(".loads select").focus();
    await page.keyboard.press("ArrowRight");
    expect(await clock(page)).toBeCloseTo(1 / 60, 2);
    await page.keyboard.press("ArrowLeft");
    expect(await clock(page)).toBe(0);
    await page.keyboard.press("Shift+ArrowRight");
    expect(await clock(page)).toBeCloseTo(0.48, 2); // the crank is level
    expect(await page.locator(".loads select").inputValue()).not.toBe("1");
    await page.close();
  });

  test("backwards from the start it runs from the end", async () => {
    const page = await open("four_bar.html");
    await page.getByLabel("backwards").click();
    await page.getByLabel("play or pause").click();
    await page.waitForTimeout(200);
    expect(await clock(page)).toBeGreaterThan(9);
    await page.close();
  });

  test("the wheel with Ctrl zooms, a drag pans, fit shows all again", async () => {
    const page = await open("four_bar.html");
    const transform = (): Promise<string | null> => page.locator(".mechanism .world").first().getAttribute("transform");
    const before = await transform();
    const box = (await page.locator(".mechanism svg").boundingBox())!;
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.wheel(0, -200);
    expect(await transform()).toBe(before);
    await page.evaluate(() => scrollTo(0, 0));
    await page.keyboard.down("Control");
    await page.mouse.wheel(0, -200);
    await page.keyboard.up("Control");
    const zoomed = await transform();
    expect(zoomed).not.toBe(before);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width / 2 + 50, box.y + box.height / 2 + 20, { steps: 4 });
    await page.mouse.up();
    expect(await transform()).not.toBe(zoomed);
    await page.getByRole("button", { name: "fit" }).click();
    expect(await transform()).toBe(before);
    await page.close();
  });

  test("plots and mechanism say in words what they show", async () => {
    const page = await open("four_bar.html");
    expect(await page.locator(".mechanism svg").getAttribute("aria-label")).toContain("crank, coupler, rocker");
    const label = await page.getByRole("img", { name: /^Energy \[J\] over time/ }).getAttribute("aria-label");
    expect(label).toMatch(/kinetic from 0 to 14\.\d+/);
    await page.close();
  });

  test("a body that is followed stays in the middle", async () => {
    const page = await open("four_bar.html");
    await page.locator(".view select").selectOption({ label: "coupler" });
    const places = [];
    for (const part of [0.1, 0.35]) {
      await seek(page, part);
      places.push(await page.locator(".mechanism path.body").nth(1).evaluate((path: SVGPathElement) => {
        const { x, y } = new DOMPoint(0, 0).matrixTransform(path.getScreenCTM()!);
        return [Math.round(x), Math.round(y)];
      }));
    }
    expect(places[0]).toEqual(places[1]);
    await page.close();
  });

  test("names, paths and ghosts come when they are asked for", async () => {
    const page = await open("four_bar.html");
    const count = (selector: string): Promise<number> => page.locator(`.mechanism ${selector}`).count();
    expect(await count("text.bodies")).toBe(0);
    await page.getByRole("button", { name: "bodies" }).click();
    expect(await count("text.bodies")).toBe(3);
    const before = await count(".world > path");
    await page.getByLabel("ghosts").check();
    expect(await count(".world > path")).toBe(before + 27);
    await page.getByText("paths").click();
    const box = page.locator(".points input:not(:checked)").first();
    const paths = await count("path.all");
    await box.check();
    expect(await count("path.all")).toBe(paths + 1);
    await page.close();
  });

  test("a drag in a plot moves the mechanism", async () => {
    const page = await open("four_bar.html");
    const before = await page.locator(".mechanism path.body").nth(1).getAttribute("transform");
    const plot = page.locator(".plot > div > svg").first();
    await plot.scrollIntoViewIfNeeded();
    const box = (await plot.boundingBox())!;
    await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    expect(await clock(page)).toBeGreaterThan(3);
    expect(await page.locator(".mechanism path.body").nth(1).getAttribute("transform")).not.toBe(before);
    await page.close();
  });

  test("a stretch of time that is marked with Shift is shown in all plots", async () => {
    const page = await open("four_bar.html");
    const plot = page.locator(".plot > div > svg").first();
    await plot.scrollIntoViewIfNeeded();
    const box = (await plot.boundingBox())!;
    await page.keyboard.down("Shift");
    await page.mouse.move(box.x + 0.3 * box.width, box.y + 100);
    await page.mouse.down();
    await page.mouse.move(box.x + 0.5 * box.width, box.y + 100, { steps: 3 });
    await page.mouse.up();
    await page.keyboard.up("Shift");
    const buttons = page.getByRole("button", { name: "all of it" });
    expect(await buttons.count()).toBeGreaterThan(4);
    await buttons.first().click();
    expect(await buttons.count()).toBe(0);
    await page.close();
  });

  test("a curve is left out and drawn again, and any quantity stands over any other", async () => {
    const page = await open("four_bar.html");
    const card = page.locator(".plot").first();
    const curves = await card.locator(".curve").count();
    await card.locator(".legend button").first().click();
    expect(await card.locator(".curve").count()).toBe(curves - 1);
    await card.locator(".legend button").first().click();
    expect(await card.locator(".curve").count()).toBe(curves);
    const phase = page.locator(".plot").last();
    const path = (): Promise<string | null> => phase.locator(".curve").getAttribute("d");
    const before = await path();
    await phase.getByLabel("across").selectOption({ label: "x of coupler.end [m]" });
    expect(await path()).not.toBe(before);
    await page.close();
  });

  test("a quantity goes around an angle", async () => {
    const page = await open("four_bar.html");
    await page.getByLabel("around").check();
    expect(await page.locator("circle.ring").count()).toBeGreaterThan(2);
    expect(await page.locator("svg:has(circle.ring) path.curve").getAttribute("d")).toMatch(/^M/);
    await page.close();
  });

  test("many lines that are alike are one that opens", async () => {
    const page = await open("four_bar.html");
    const rows = (): Promise<number> => page.locator("tr.folded:visible").count();
    expect(await rows()).toBe(0);
    await page.locator("tr.fold button").first().click();
    expect(await rows()).toBeGreaterThan(4);
    await page.close();
  });

  test("a body that is clicked is cut free, with its balances", async () => {
    const page = await open("four_bar.html");
    const place = await page.locator(".mechanism path.body").nth(1).evaluate((path: SVGPathElement) => {
      const { x, y } = new DOMPoint(0.15, 0).matrixTransform(path.getScreenCTM()!); // of the coupler, beside its mass centre
      return { x, y };
    });
    await page.mouse.click(place.x, place.y);
    expect(await page.locator("figure.cut svg").count()).toBe(2);
    expect(await page.locator(".balance").count()).toBe(3);
    expect(await page.locator("figure.cut .arrow.effective").count()).toBe(1);
    await page.close();
  });

  test("arrow, term and curve light up together", async () => {
    const page = await open("four_bar.html");
    await page.locator(".loads select").selectOption({ label: "crank" });
    await seek(page, 0.07);
    const lit = (selector: string): Promise<number> => page.locator(selector).count();

    await page.locator("figure.cut .arrow[aria-label='A'] .wide").first().hover({ force: true });
    expect(await lit(".balance .lit")).toBe(4); // A_x along x, A_y along y, both about G
    expect(await lit(".plot .curve.lit")).toBe(1);
    await page.mouse.move(0, 0);
    expect(await lit(".lit")).toBe(0);

    await page.locator(".balance").nth(0).locator("button").first().click();
    await page.mouse.move(0, 0);
    expect(await lit("figure.cut .arrow.lit")).toBe(1);
    expect(await lit(".plot .curve.lit")).toBe(1);
    await page.locator(".balance").nth(0).locator("button").first().click();
    await page.mouse.move(0, 0);

    await page.locator(".plot .near").first().dispatchEvent("click");
    expect(await lit("figure.cut .arrow.lit")).toBe(1);
    expect(await lit(".balance .lit")).toBe(4);
    await page.close();
  });
});
