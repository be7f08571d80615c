"""The report on a desk and on a telephone: quiet, whole, inside the window, legible, by keys."""

import pytest

WIDTHS = (1280, 390)
LEAST_LETTERS = 10.0  # pixels
PIXELS_TO_A_POINT = 96.0 / 72.0
LEAST_CONTRAST = 4.5  # WCAG 2, of text; 3 for large text
MOST_KEYS = 200
TAB = 9

# Elements that hold text of their own, with the colours that it is seen in.
COLOURS = """
(() => {
  const texts = [];
  const rgb = (text) => text.match(/[\\d.]+/g).map(Number);
  for (const element of document.body.querySelectorAll("*")) {
    const written = [...element.childNodes].some((n) => n.nodeType === 3 && n.textContent.trim());
    if (!written || !element.getClientRects().length) continue;
    let behind = element;
    while (behind && rgb(getComputedStyle(behind).backgroundColor)[3] === 0)
      behind = behind.parentElement;
    const style = getComputedStyle(element);
    texts.push({
      text: element.textContent.trim().slice(0, 40),
      size: parseFloat(style.fontSize),
      heavy: Number(style.fontWeight) >= 700,
      front: rgb(style.color),
      back: behind ? rgb(getComputedStyle(behind).backgroundColor) : [255, 255, 255],
    });
  }
  return texts;
})()
"""
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
each_width = pytest.mark.parametrize("width", WIDTHS)


@pytest.mark.parametrize("width", [1280, 768, 390])
def test_the_page_is_whole_and_fits(tab, wavy_file, width):
    page = tab(wavy_file, width)
    assert page.complaints() == []
    inside, across = page.value("[innerWidth, document.documentElement.scrollWidth]")
    assert inside == width
    assert across <= width
    assert page.value(OUTSIDE) == []
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


def luminance(colour: list[float]) -> float:
    """Relative luminance of sRGB, WCAG 2.2."""
    linear = [
        c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4
        for c in (v / 255.0 for v in colour[:3])
    ]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one: list[float], other: list[float]) -> float:
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


def test_contrast_is_as_defined():
    assert contrast([0, 0, 0], [255, 255, 255]) == pytest.approx(21.0)
    assert contrast([119, 119, 119], [255, 255, 255]) == pytest.approx(4.48, abs=0.01)


@each_width
def test_every_text_stands_out_from_its_ground(tab, wavy_file, width):
    texts = tab(wavy_file, width).value(COLOURS)
    assert len(texts) > 100
    for text in texts:
        large = text["size"] >= 24.0 or (text["heavy"] and text["size"] >= 18.66)
        least = 3.0 if large else LEAST_CONTRAST
        assert contrast(text["front"], text["back"]) >= least, text


@each_width
def test_the_keyboard_reaches_all_that_scrolls_and_every_control(tab, wavy_file, width):
    page = tab(wavy_file, width)
    page.value("document.querySelectorAll('*').forEach((e, k) => (e.dataset.number = k))")
    wanted = page.value(
        """[...document.querySelectorAll("*")].filter((e) =>
          e.matches("select, input, a, button, summary") || (e.scrollWidth > e.clientWidth + 1
            && ["auto", "scroll"].includes(getComputedStyle(e).overflowX)))
          .map((e) => e.dataset.number)"""
    )
    assert len(wanted) > (15 if width < 700 else 3)
    reached = set()
    for _ in range(MOST_KEYS):
        page.press("Tab", TAB)
        number = page.value("document.activeElement.dataset.number")
        if number in reached:
            break
        reached.add(number)
    body = page.value("document.body.dataset.number")  # after the last
    assert set(wanted) == reached - {None, body}  # and stops nowhere else
