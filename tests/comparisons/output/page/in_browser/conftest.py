"""A real browser without a window, spoken to over two pipes (its own DevTools protocol).

Tests that ask for it are skipped where no Chromium or Chrome starts.
"""

import fcntl
import json
import os
import select
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from comparisons.output.page.pdf import browser as installed
from comparisons.output.page.pdf import options

PATIENCE = 120.0  # s, for one answer
# The browser reads its orders from the third file that it inherits, and answers on the fourth.
START = """
import os, sys
reads, writes, *command = sys.argv[1:]
os.dup2(int(reads), 3)
os.dup2(int(writes), 4)
os.execv(command[0], command)
"""
HIGH = 10  # files below are for the browser
# Of every text and picture that is seen the size of its letters, in points; in pictures they are
# outlines of a font of a hundred units.
LETTERS = r"""
(() => {
  const out = [];
  for (const element of document.body.querySelectorAll("*")) {
    if (!element.getClientRects().length) continue;
    if ([...element.childNodes].some((n) => n.nodeType === 3 && n.textContent.trim()))
      out.push([parseFloat(getComputedStyle(element).fontSize) * 0.75 * element.currentCSSZoom,
        element.textContent.slice(0, 60)]);
    const drawn = element.currentSrc ? atob(element.currentSrc.split(",")[1]) : "";
    const units = [...drawn.matchAll(/scale\(([\d.]+) -[\d.]+\)/g)].map((found) => 100 * found[1]);
    const shown = element.getBoundingClientRect().width / element.naturalWidth;
    if (units.length) out.push([Math.min(...units) * shown, element.alt]);
  }
  return out;
})()
"""


class Browser:
    """A running browser."""

    def __init__(self, program: str, profile: Path) -> None:
        ends = [fcntl.fcntl(end, fcntl.F_DUPFD, HIGH) for end in (*os.pipe(), *os.pipe())]
        reads, self._orders, self._answers, writes = ends
        command = [program, *options(str(profile)), "--remote-debugging-pipe", "about:blank"]
        self._process = subprocess.Popen(
            [sys.executable, "-c", START, str(reads), str(writes), *command],
            pass_fds=(reads, writes),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        os.close(reads)
        os.close(writes)
        self._count, self._rest, self.events = 0, b"", []

    def ask(self, method: str, session: str | None = None, **parameters: object) -> dict:
        """Reply of the browser to one order."""
        self._count += 1
        order = {"id": self._count, "method": method, "params": parameters}
        order |= {"sessionId": session} if session else {}
        os.write(self._orders, json.dumps(order).encode() + b"\0")
        number = self._count
        answer = self.wait(lambda message: message.get("id") == number)
        assert "error" not in answer, (method, answer["error"])
        return answer["result"]

    def wait(self, wanted: Callable[[dict], bool]) -> dict:
        """The next message that is wanted; all others are kept in `events`."""
        end = time.monotonic() + PATIENCE
        while True:
            while b"\0" not in self._rest:
                ready, _, _ = select.select([self._answers], [], [], end - time.monotonic())
                assert ready, "the browser does not answer"
                self._rest += os.read(self._answers, 1 << 20)
            text, _, self._rest = self._rest.partition(b"\0")
            message = json.loads(text)
            if wanted(message):
                return message
            self.events.append(message)

    def close(self) -> None:
        self.ask("Browser.close")
        self._process.wait(PATIENCE)
        os.close(self._orders)
        os.close(self._answers)


class Tab:
    """A page in the browser, so many pixels wide."""

    def __init__(self, browser: Browser, page: Path, width: int) -> None:
        self._browser = browser
        target = browser.ask("Target.createTarget", url="about:blank")["targetId"]
        self._session = browser.ask("Target.attachToTarget", targetId=target, flatten=True)[
            "sessionId"
        ]
        browser.events.clear()
        for domain in ("Page", "Runtime", "Log"):
            self.ask(f"{domain}.enable")
        self.resize(width)
        self.ask("Page.navigate", url=page.resolve().as_uri())
        browser.wait(lambda message: message.get("method") == "Page.loadEventFired")
        self.value("for (const folded of document.querySelectorAll('details')) folded.open = true")

    def resize(self, width: int) -> None:
        self.ask(
            "Emulation.setDeviceMetricsOverride",
            width=width,
            height=900,
            deviceScaleFactor=1,
            mobile=False,
        )

    def ask(self, method: str, **parameters: object) -> dict:
        return self._browser.ask(method, self._session, **parameters)

    def value(self, expression: str) -> object:
        """Value of a JavaScript expression; waits for a promise."""
        answer = self.ask(
            "Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True
        )
        assert "exceptionDetails" not in answer, answer["exceptionDetails"]
        return answer["result"].get("value")

    def letters(self) -> list[tuple[float, str]]:
        """Sizes of all letters that are seen, in points, and where they stand."""
        return self.value(LETTERS)

    def press(self, key: str, code: int, text: str = "") -> None:
        named = {"key": key, "code": key, "windowsVirtualKeyCode": code}
        self.ask("Input.dispatchKeyEvent", type="keyDown", text=text, **named)
        self.ask("Input.dispatchKeyEvent", type="keyUp", **named)

    def complaints(self) -> list[str]:
        """Complaints about the page on the browser's console."""
        problems = []
        for event in self._browser.events:
            parameters = event.get("params", {})
            if event.get("method") == "Runtime.exceptionThrown":
                problems.append(str(parameters["exceptionDetails"]))
            entry = parameters.get("entry", {})
            if event.get("method") == "Log.entryAdded" and entry["level"] != "verbose":
                problems.append(entry["text"])
            if event.get("method") == "Runtime.consoleAPICalled":
                problems.append(str(parameters["args"]))
        return problems

    def close(self) -> None:
        self.ask("Page.close")


@pytest.fixture(scope="session")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    program = installed()
    if program is None:
        pytest.skip("no Chromium or Chrome starts here")
    running = Browser(program, tmp_path_factory.mktemp("browser"))
    yield running
    running.close()


@pytest.fixture
def tab(browser: Browser) -> Iterator[Callable[..., Tab]]:
    """`tab(page, width)`: the page in the browser."""
    opened: list[Tab] = []

    def open_one(page: Path, width: int) -> Tab:
        opened.append(Tab(browser, page, width))
        return opened[-1]

    yield open_one
    for one in opened:
        one.close()


@pytest.fixture(scope="session")
def wavy_file(wavy_outcome, rendered, tmp_path_factory) -> Path:
    """The report of a rough run with two friction coefficients, as a file."""
    page = tmp_path_factory.mktemp("wavy") / "report.html"
    page.write_text(rendered(wavy_outcome), encoding="utf-8")
    return page
