/** Rows of a table that are much alike stand as one line, which opens. */
export function offerFolds(): void {
  document.documentElement.classList.add("alive");
  for (const line of document.querySelectorAll<HTMLElement>("tr.fold")) {
    const button = document.createElement("button");
    button.type = "button";
    button.className = "opens";
    const rows = following(line);
    const show = (open: boolean): void => {
      button.textContent = open ? "▾" : "▸";
      button.setAttribute("aria-expanded", String(open));
      rows.forEach((row) => row.classList.toggle("open", open));
    };
    button.setAttribute("aria-label", "all of these");
    line.firstElementChild!.prepend(button);
    line.addEventListener("click", () => show(button.getAttribute("aria-expanded") !== "true"));
    show(false);
  }
}

function following(line: Element): Element[] {
  const rows: Element[] = [];
  for (let row = line.nextElementSibling; row?.classList.contains("folded"); row = row.nextElementSibling) rows.push(row);
  return rows;
}
