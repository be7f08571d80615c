"""A page printed to PDF by a browser without a window, where one is installed."""

import os
import shutil
import subprocess
import tempfile
from pathlib import Path

from comparisons.common.files import PDF, REPORT, check_writable, claim, write_whole

BROWSERS = (
    *("chromium", "chromium-browser", "chromium-headless-shell", "chrome-headless-shell"),
    *("google-chrome", "google-chrome-stable", "microsoft-edge"),
)
REMEDY = "apt-get install --no-install-recommends chromium"
PATIENCE = 120.0  # s; a page of 5 MB takes two on a machine that does nothing else


def browser() -> str | None:
    """The first Chromium or Chrome on the PATH that starts: Ubuntu's only asks for its snap."""
    return next(filter(_starts, filter(None, map(shutil.which, BROWSERS))), None)


def _starts(program: str) -> bool:
    silent = {"capture_output": True, "stdin": subprocess.DEVNULL, "timeout": PATIENCE}
    try:
        return subprocess.run([program, "--version"], **silent).returncode == 0
    except (OSError, subprocess.TimeoutExpired):
        return False


def options(profile: str) -> list[str]:
    """Options to start a browser with: no window, nothing of the user's, no network."""
    words = ["--headless", "--disable-gpu", "--disable-extensions", "--no-first-run"]
    words += ["--disable-background-networking", f"--user-data-dir={profile}"]
    # as root a browser refuses to start with a sandbox; the pages are this program's own
    return [*words, "--no-sandbox"] if os.geteuid() == 0 else words


def print_report(folder: Path) -> str:
    """Print a run's report.html into report.pdf beside it; why that could not be, if so. Raises
    InputError where somebody else wrote a report.pdf there."""
    check_writable(folder)
    if not (why_not := print_pdf(folder / REPORT, folder / PDF)):
        claim(folder, PDF)
    return why_not


def print_pdf(page: Path, target: Path, patience: float = PATIENCE) -> str:
    """Print a page into `target`, which appears whole or not at all. Returns in one sentence why it
    could not be printed, and what to do; else nothing."""
    program, by_hand = browser(), f"print {page} from any browser"
    if program is None:
        return (
            f"{target}: not printed: no Chromium or Chrome starts here; "
            f"{REMEDY} gets one (of Ubuntu: snap install chromium), or {by_hand}"
        )
    with tempfile.TemporaryDirectory(prefix="crosscheck-", ignore_cleanup_errors=True) as scratch:
        part = Path(scratch, target.name)
        printing = "--no-pdf-header-footer", f"--print-to-pdf={part}"
        command = [program, *options(scratch), *printing, page.resolve().as_uri()]
        silent = {"capture_output": True, "stdin": subprocess.DEVNULL}
        try:
            ended = subprocess.run(command, timeout=patience, **silent).returncode
            why = f"ended with {ended} and left no PDF"
            content = part.read_bytes() if part.is_file() else b""
        except subprocess.TimeoutExpired:
            why, content = f"did not end within {patience:g} s", b""
    if not (content.startswith(b"%PDF-") and content.rstrip().endswith(b"%%EOF")):
        return f"{target}: not printed: {program} {why}; {by_hand}"
    write_whole(target, content)
    return ""
