"use strict";

// Tables: a head sorts by its column, up at first, then down. Rows without a number come last either way.
for (const table of document.querySelectorAll("table")) {
  const heads = [...table.tHead.rows[0].cells];
  const body = table.tBodies[0];
  const words = new Intl.Collator("en", { numeric: true });

  heads.forEach((head, column) => {
    head.querySelector("button").addEventListener("click", () => {
      const down = head.getAttribute("aria-sort") === "ascending";
      const sign = down ? -1 : 1;
      const number = row => {
        const value = row.cells[column].dataset.value;
        return value === undefined ? NaN : Number(value);
      };
      const order = (a, b) => {
        const [x, y] = [number(a), number(b)];
        if (Number.isNaN(x) !== Number.isNaN(y)) return Number.isNaN(x) ? 1 : -1;
        if (!Number.isNaN(x)) return sign * (x - y);
        return sign * words.compare(a.cells[column].textContent, b.cells[column].textContent);
      };
      body.append(...[...body.rows].sort(order));
      for (const other of heads) other.setAttribute("aria-sort", "none");
      head.setAttribute("aria-sort", down ? "descending" : "ascending");
    });
  });
}

// Plots: the point nearest to the pointer, a finger or, by the arrow keys, the last one shown says its values.
const tip = document.createElement("div");
tip.id = "tip";
tip.setAttribute("role", "status");
tip.hidden = true;
document.body.append(tip);

// As far from a point as its values still show, in CSS pixels: a fingertip is wider than a pointer.
const REACH = { mouse: 24, pen: 24, touch: 44 };

for (const svg of document.querySelectorAll(".plot svg")) {
  const points = [...svg.querySelectorAll(".hits circle")].map(circle => {
    const title = circle.querySelector("title");
    // Else the browser shows it a second time.
    title.remove();
    return { circle, text: title.textContent, x: circle.cx.baseVal.value, y: circle.cy.baseVal.value };
  });
  if (points.length === 0) continue;
  svg.tabIndex = 0;
  const inOrder = [...points].sort((a, b) => a.x - b.x || a.y - b.y);
  const ring = document.createElementNS(svg.namespaceURI, "circle");
  ring.setAttribute("class", "here");
  ring.setAttribute("r", "36");
  let shown = null;

  const show = point => {
    shown = point;
    ring.setAttribute("cx", point.x);
    ring.setAttribute("cy", point.y);
    svg.append(ring);
    tip.textContent = point.text;
    tip.hidden = false;
    const at = point.circle.getBoundingClientRect();
    const middle = (at.left + at.right) / 2 - tip.offsetWidth / 2;
    const left = Math.max(8, Math.min(middle, document.documentElement.clientWidth - tip.offsetWidth - 8));
    const above = at.top - tip.offsetHeight - 4;
    tip.style.left = `${left + scrollX}px`;
    tip.style.top = `${(above < 4 ? at.bottom + 4 : above) + scrollY}px`;
  };
  const hide = () => {
    shown = null;
    ring.remove();
    tip.hidden = true;
  };
  const follow = event => {
    const box = svg.getBoundingClientRect();
    const scale = svg.viewBox.baseVal.width / box.width;
    const [x, y] = [(event.clientX - box.left) * scale, (event.clientY - box.top) * scale];
    const reach = (REACH[event.pointerType] ?? REACH.mouse) * scale;
    let nearest = null;
    let least = reach;
    for (const point of points) {
      const distance = Math.hypot(point.x - x, point.y - y);
      if (distance < least) [nearest, least] = [point, distance];
    }
    if (nearest === null) hide();
    else if (nearest !== shown) show(nearest);
  };

  svg.addEventListener("pointermove", follow);
  svg.addEventListener("pointerdown", follow);
  svg.addEventListener("pointerleave", event => {
    // A finger that is lifted leaves, and what it asked for is still to be read.
    if (event.pointerType === "mouse") hide();
  });
  svg.addEventListener("blur", hide);
  svg.addEventListener("keydown", event => {
    if (event.key === "Escape") return hide();
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    const at = inOrder.indexOf(shown);
    const next = at < 0 ? (step > 0 ? 0 : inOrder.length - 1) : at + step;
    show(inOrder[Math.max(0, Math.min(next, inOrder.length - 1))]);
  });
}
