"""The Pareto front of times and errors."""

from burnish.study.pareto import pareto_front


def rows(*pairs):
    return [{"ms": time, "error": error} for time, error in pairs]


def front(*pairs):
    return [(row["ms"], row["error"]) for row in pareto_front(rows(*pairs), "error", "ms")]


def test_what_is_slower_and_worse_is_left_out():
    assert front((3, 0.1), (1, 0.5), (2, 0.6), (2, 0.2), (4, 0.1), (5, 0.05)) == [
        (1, 0.5),
        (2, 0.2),
        (3, 0.1),
        (5, 0.05),
    ]


def test_of_equals_one_is_kept():
    assert front((1, 0.5), (1, 0.5)) == [(1, 0.5)]
    assert front((1, 0.6), (1, 0.5)) == [(1, 0.5)]


def test_what_was_not_measured_is_left_out():
    assert front((1, None), (2, 0.3), (None, 0.1)) == [(2, 0.3)]
    assert front() == []


def test_nothing_outside_the_front_beats_it(rng):
    pairs = [(float(a), float(b)) for a, b in rng.random((200, 2))]
    kept = front(*pairs)
    assert kept == [
        p for p in sorted(pairs) if not any(q[0] <= p[0] and q[1] <= p[1] and q != p for q in pairs)
    ]
