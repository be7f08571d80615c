
"use strict";
// Every head becomes a button that sorts by its column; a second press turns the order round.
const table = document.querySelector(".runs");
const body = table.tBodies[0];
const heads = [...table.tHead.rows[0].cells];

function sortBy(column) {
  const head = heads[column];
  const down = head.getAttribute("aria-sort") === "ascending";
  for (const other of heads) other.removeAttribute("aria-sort");
  head.setAttribute("aria-sort", down ? "descending" : "ascending");
  const words = column < 2;
  const keyed = [...body.rows].map((row) => {
    const value = row.cells[column].dataset.value;
    return { row, empty: value === "", key: words ? value : Number(value) };
  });
  keyed.sort((one, other) => {
    if (one.empty || other.empty) return one.empty - other.empty; // last in either order
    const order = words ? one.key.localeCompare(other.key) : one.key - other.key;
    return down ? -order : order;
  });
  body.append(...keyed.map(({ row }) => row));
}

heads.forEach((head, column) => {
  const button = document.createElement("button");
  button.type = "button";
  button.append(...head.childNodes);
  button.addEventListener("click", () => sortBy(column));
  head.append(button);
});
