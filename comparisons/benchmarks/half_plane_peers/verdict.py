"""What a race of codes has shown: times and errors against the best peer on every case."""

from dataclasses import dataclass

from comparisons.benchmarks.half_plane_peers.race import Entry

WANTED = {4096: 3.0, 65536: 20.0}  # times faster than the fastest peer; elsewhere never slower
SAME = 1e-3  # by which two errors may differ and count as equal


@dataclass(frozen=True)
class Verdict:
    """One demand on one case, and whether it holds."""

    holds: bool
    text: str


def verdicts(case: str, count: int, ours: Entry, peers: list[Entry]) -> list[Verdict]:
    """Demands on `ours` beside the `peers` on one case of `count` nodes."""
    title = f"{case}, n = {count}"
    found = [Verdict(ours.meets, f"{title}: ours meets the yardstick")]
    for peer in peers:
        if not (peer.meets or peer.over):
            found.append(Verdict(True, f"{title}: {peer.code} never meets the yardstick"))
    rivals = [peer for peer in peers if peer.meets or peer.over]
    if not rivals:
        return found
    fastest = min(rivals, key=lambda peer: peer.seconds)
    wanted = WANTED.get(count, 1.0)
    ratio = fastest.seconds / ours.seconds
    found.append(Verdict(ratio >= wanted, f"{title}: {ratio:.3g} times faster, wanted {wanted:g}"))
    exact = [peer.measure.error for peer in rivals if peer.meets]
    if exact:
        least = min(exact)
        small = ours.measure.error <= (1.0 + SAME) * least
        text = f"{title}: error {ours.measure.error:.3g}, of the best peer {least:.3g}"
        found.append(Verdict(small, text))
    return found
