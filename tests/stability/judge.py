"""The frame of random judges: numbered scenes, what they are held to, how a run of them ends."""

from collections import Counter
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

import asperity


class NoTruth(Exception):
    """A scene that nothing is known of to hold it to."""


# what is held, its error over what is allowed, and what is said of it where that is more than 1
Held = tuple[str, float, Any]


def judged(scenes: Iterable[int], compute: Callable[[int], Iterable[Held]]) -> int:
    """Print what exceeds and, at the end, a line of each kind; return the exit status.

    It is 1 where anything exceeds, and where a scene ends in an error of the package. Scenes
    without a truth are counted.
    """
    errors: dict[str, list[float]] = {}
    ended: Counter[str] = Counter()
    for scene in scenes:
        try:
            held = list(compute(scene))
        except (asperity.Error, NoTruth) as error:
            ended[type(error).__name__] += 1
            print(f"scene {scene}: {error}", flush=True)
            continue
        for kind, ratio, said in held:
            errors.setdefault(kind, []).append(ratio)
            if not ratio <= 1:
                print(f"scene {scene}, {kind}: {ratio:.3g} of what is allowed; {said}", flush=True)
    exceeded = 0
    for kind, ratios in sorted(errors.items()):
        exceeded += sum(not ratio <= 1 for ratio in ratios)
        median, most = np.quantile(ratios, 0.5), max(ratios)
        print(f"{kind}: {len(ratios)}, of what is allowed {median:.2g} (median), {most:.3g} (most)")
    print(f"{exceeded} exceeded; ended in {dict(ended)}")
    return int(exceeded > 0 or ended.total() > ended["NoTruth"])
