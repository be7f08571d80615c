"""The report on a desk and on a telephone: quiet, whole, inside the window, legible."""

import pytest

LEAST_LETTERS = 10.0  # pixels
PIXELS_TO_A_POINT = 96.0 / 72.0

# What sticks out of the window, and cells whose text is wider than they are.
OUTSIDE = """
(() => {
  const out = [];
  for (const element of document.body.querySelectorAll("*")) {
    if (!element.getClientRects().length) continue;
    const box = element.getBoundingClientRect();
    const scrolls = element.parentElement.closest(".scroll");
    if (!scrolls && (box.right > innerWidth + 0.5 || box.left < -0.5)) out.push(element.outerHTML);
    const cell = element.matches("td, th, p, li, figcaption, label, h1, h2, h3");
    if (cell && element.scrollWidth > element.clientWidth + 1 && element.clientWidth)
      out.push(element.outerHTML);
  }
  return out.map((text) => text.slice(0, 120));
})()
"""


# The white below the bars and facts, over the height of the picture beside them.
WHITE = """
(() => {
  const [left, right] = [...document.querySelectorAll(".answer > *")].map((e) =>
    e.getBoundingClientRect());
  return (right.bottom - left.bottom) / right.height;
})()
"""


@pytest.mark.parametrize("width", [1280, 768, 390])
def test_the_page_is_whole_and_fits(tab, wavy_file, width):
    page = tab(wavy_file, width)
    assert page.complaints() == []
    inside, across = page.value("[innerWidth, document.documentElement.scrollWidth]")
    assert inside == width
    assert across <= width
    assert page.value(OUTSIDE) == []
    assert width < 1280 or 0.0 <= page.value(WHITE) < 0.25
    pictures = page.value(
        "Promise.all([...document.images].map((i) => i.decode().then(() => i.naturalWidth)))"
    )
    assert len(pictures) > 15
    assert min(pictures) > 100
    shown = page.value("[...document.images].map((i) => i.clientWidth)")
    assert 0.5 * min(width, 1100) < max(shown) <= max(width, 896)
    hints = page.value("[...document.querySelectorAll('figure .hint')].map((h) => h.offsetHeight)")
    assert any(hints) == (max(shown) > width)
    assert min(size for size, _ in page.letters()) * PIXELS_TO_A_POINT >= LEAST_LETTERS
