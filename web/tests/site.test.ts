/** Pages in a browser, on a desk and on a telephone; FREEBODY_SITE is a folder with some, which tests/views/test_site.py writes. */

import { readdirSync } from "node:fs";
import { join } from "node:path";
import { type Browser, chromium } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

const folder = process.env.FREEBODY_SITE ?? "";
const files = folder ? (readdirSync(folder, { recursive: true }) as string[]) : [];
const pages = files.filter((name) => name.endsWith(".html") && !/-report(-\d+)?\.html$/.test(name));

let browser: Browser;
beforeAll(async () => {
  if (folder) browser = await chromium.launch({ executablePath: process.env.FREEBODY_CHROMIUM, args: ["--no-sandbox"] });
});
afterAll(async () => browser?.close());

describe.runIf(folder)("every page", () => {
  test.each(pages)("%s opens without complaint, and no wider than the screen", async (name) => {
    for (const [width, colorScheme] of [[1280, "light"], [390, "dark"]] as const) {
      const page = await browser.newPage({ viewport: { width, height: 844 }, colorScheme });
      const complaints: string[] = [];
      page.on("pageerror", (error) => complaints.push(String(error)));
      page.on("console", (message) => complaints.push(message.text()));
      page.on("requestfailed", (request) => complaints.push(request.url()));
      await page.goto(`file://${join(folder, name)}`);
      expect(complaints).toEqual([]);
      expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(width);
      await page.close();
    }
  });
});

test.runIf(files.includes("site.js"))("the index shows what one looks for", async () => {
  const page = await browser.newPage();
  await page.goto(`file://${join(folder, "index.html")}`);
  const shown = () => page.locator(".card:not([hidden])").count();
  const all = await shown();
  await page.locator("#filter").fill("zzz");
  expect(await shown()).toBe(0);
  await page.locator("#filter").fill("");
  expect(await shown()).toBe(all);
  await page.close();
});
