"""The pipeline once more, slow and obvious: plain lists and loops, one pose at a time, nothing shared with the core.

A polyline is a list of (time, weight) with rising times, straight between knots and 0 outside. Each function
reads one stage of the design as literally as possible; the tests compare it with the fast pipeline.
"""

from __future__ import annotations

import itertools
from bisect import bisect_right

Polyline = list[tuple[float, float]]

RAMP = 1e-3  # seconds: how steep a step is drawn
TINY = 1e-9


def value(line: Polyline, t: float) -> float:
    """The height at time t."""
    if not line or t < line[0][0] or t > line[-1][0]:
        return 0.0
    k = bisect_right(line, (t, 2.0)) - 1
    if k == len(line) - 1 or line[k][0] == t:
        return line[k][1]
    (t0, v0), (t1, v1) = line[k], line[k + 1]
    return v0 + (v1 - v0) * (t - t0) / (t1 - t0)


# --- red ---------------------------------------------------------------------------------------------------------


def warp(keys: Polyline, begin: float, end: float) -> Polyline:
    """One authored curve over the span of its bigram, closed by ramps of 1 ms inside the span."""
    if all(v == 0 for _, v in keys):
        return []
    keys = list(keys)
    if keys[0][1] > 0 and keys[0][0] > 0:
        keys.insert(0, (0.0, keys[0][1]))
    if keys[-1][1] > 0 and keys[-1][0] < 1:
        keys.append((1.0, keys[-1][1]))
    line = [(begin + s * (end - begin), v) for s, v in keys]
    closed = list(line)
    if line[0][1] > 0:
        (t0, _), (t1, _) = line[0], line[1]
        inside = t0 + min(RAMP, (t1 - t0) / 3)
        closed[0:1] = [(t0, 0.0), (inside, value(line, inside))]
    if line[-1][1] > 0:
        (t0, _), (t1, _) = line[-2], line[-1]
        inside = t1 - min(RAMP, (t1 - t0) / 3)
        closed[-1:] = [(inside, value(line, inside)), (t1, 0.0)]
    return closed


def red(phones, times, bigrams, pose) -> list[tuple[int, Polyline]]:
    """(bigram index, polyline) of every curve of one pose; `bigrams` is (first, second) → pose → keys."""
    found = []
    for i in range(len(phones) - 1):
        keys = bigrams.get((phones[i], phones[i + 1]), {}).get(pose)
        line = warp(keys, times[i], times[i + 2]) if keys else []
        if line:
            found.append((i, line))
    return found


# --- blue --------------------------------------------------------------------------------------------------------


def envelope(lines: list[Polyline], choose) -> Polyline:
    """The highest (choose=max) or lowest (min) of several polylines, with a knot at every crossing."""
    times = sorted({t for line in lines for t, _ in line})
    knots: list[float] = times[:1]
    for t0, t1 in itertools.pairwise(times):
        ends = [(value(line, t0), value(line, t1)) for line in lines]
        inner = []
        for k, (a0, a1) in enumerate(ends):
            for b0, b1 in ends[k + 1 :]:
                if (a0 - b0) * (a1 - b1) < 0:
                    inner.append(t0 + (t1 - t0) * (a0 - b0) / ((a0 - b0) - (a1 - b1)))
        knots += [*sorted(t for t in set(inner) if t0 < t < t1), t1]
    return [(t, choose(value(line, t) for line in lines)) for t in knots]


def blue(reds: list[tuple[int, Polyline]]) -> Polyline:
    """The maximum of all red curves of a pose."""
    return envelope([line for _, line in reds], max) if reds else []


# --- yellow ------------------------------------------------------------------------------------------------------


def maxima(line: Polyline) -> list[tuple[int, int]]:
    """First and last knot of every peak: above 0, no higher neighbour, a plateau counted once."""
    found = []
    k = 0
    while k < len(line):
        last = k
        while last + 1 < len(line) and abs(line[last + 1][1] - line[last][1]) <= TINY:
            last += 1
        before = line[k - 1][1] if k else 0.0
        after = line[last + 1][1] if last + 1 < len(line) else 0.0
        if line[k][1] > before + TINY and line[last][1] > after + TINY:
            found.append((k, last))
        k = last + 1
    return found


def yellow(line: Polyline, window: float) -> Polyline:
    """Between adjacent peaks at most `window` apart: max(line, chord); repeated until nothing changes."""
    while True:
        peaks = maxima(line)
        near = []
        for (_, a), (b, _) in itertools.pairwise(peaks):
            (ta, va), (tb, vb) = line[a], line[b]
            chord = [va + (vb - va) * (t - ta) / (tb - ta) for t, _ in line[a : b + 1]]
            if tb - ta <= window + TINY:
                near.append((a, b, chord))
        if not near:
            return line
        for a, b, chord in reversed(near):  # from the right, so that the indices on the left stay right
            straight = [(t, c) for (t, _), c in zip(line[a : b + 1], chord, strict=True)]
            raised = envelope([line[a : b + 1], straight], max)
            ends = (raised[0], raised[-1])
            above = [(t, v) for t, v in raised[1:-1] if v > value([straight[0], straight[-1]], t) + 1e-12]
            # a knot where the line leaves the chord must stay
            leave = [p for p, q in itertools.pairwise(raised) if q in above and p not in above]
            reach = [q for p, q in itertools.pairwise(raised) if p in above and q not in above]
            line = line[:a] + sorted({*ends, *above, *leave, *reach}) + line[b + 1 :]


# --- cyan --------------------------------------------------------------------------------------------------------


def active(line: Polyline) -> list[tuple[float, float]]:
    """The stretches of time in which a line is above 0; what rounding tears apart is one."""
    found: list[tuple[float, float]] = []
    for (t0, v0), (t1, v1) in itertools.pairwise(line):
        if v0 > TINY or v1 > TINY:
            if found and t0 - found[-1][1] < 1e-8:
                found[-1] = (found[-1][0], t1)
            else:
                found.append((t0, t1))
    return found


def cap(upper: Polyline, limit: float) -> Polyline:
    """What a pose may reach beside `upper`: limit − upper where upper is active, 1 elsewhere."""
    stretches = active(upper)
    line: Polyline = []
    for n, (begin, end) in enumerate(stretches):
        before = begin - stretches[n - 1][1] if n else 1.0
        after = stretches[n + 1][0] - end if n + 1 < len(stretches) else 1.0
        part = [p for p in upper if begin <= p[0] <= end]
        least = [(t, limit - v) for t, v in part]
        for bound, choose in ((0.0, max), (1.0, min)):  # clip, with a knot where it begins
            least = envelope([least, [(begin, bound), (end, bound)]], choose)
        line += [(begin - min(RAMP, before / 3), 1.0), *least, (end + min(RAMP, after / 3), 1.0)]
    return line


def cyan(tracks: dict[str, Polyline], limits: dict[tuple[str, str], float], priorities) -> dict[str, Polyline]:
    """Each pose, from the highest priority down, stays under the caps of those before it."""
    done = dict(tracks)
    order = [p for p in priorities if p in tracks]
    for k in range(len(order) - 1, -1, -1):
        lower = done[order[k]]
        if not lower:
            continue
        begin, end = lower[0][0], lower[-1][0]
        lines = [lower]
        for upper in order[k + 1 :]:
            pairs = [pair for pair in ((order[k], upper), (upper, order[k])) if pair in limits]
            if pairs and active(done[upper]):
                line = cap(done[upper], min(limits[pair] for pair in pairs))
                far = [(min(begin, line[0][0]) - 1, 1.0), *line, (max(end, line[-1][0]) + 1, 1.0)]
                lines.append(sorted(dict(reversed(far)).items()))
        low = envelope(lines, min)
        done[order[k]] = [(t, v if v > TINY else 0.0) for t, v in low if begin <= t <= end]
    return done


# --- magenta -----------------------------------------------------------------------------------------------------


def magenta(line: Polyline, speed: float, t: float) -> float:
    """The lowest at time t of all cones that stand on the line; 0 outside the line."""
    if not line or not line[0][0] <= t <= line[-1][0]:
        return 0.0
    return min(value(line, t), *(v + speed * abs(t - s) for s, v in line))


# --- all of it ---------------------------------------------------------------------------------------------------


def stages(schedule, curve_set, settings) -> dict[str, dict[str, Polyline]]:
    """Colour → pose → polyline, up to cyan."""
    bigrams = {
        pair: {pose: curve.keys() for pose, curve in bigram.curves.items()}
        for pair, bigram in curve_set.bigrams.items()
    }
    times = schedule.times.tolist()
    made: dict[str, dict[str, Polyline]] = {"blue": {}, "yellow": {}}
    for pose in curve_set.poses:
        made["blue"][pose] = blue(red(schedule.phones, times, bigrams, pose))
        made["yellow"][pose] = yellow(made["blue"][pose], settings.windows.get(pose, settings.window))
    limits = {(c.a, c.b): c.limit for c in settings.constraints if c.limit < 2}
    made["cyan"] = cyan(made["yellow"], limits, settings.priorities)
    return made
