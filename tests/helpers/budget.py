"""A benchmark's budget: held when benchmarks are timed (--benchmark-enable), not in the normal suite."""

from pytest_benchmark.fixture import BenchmarkFixture


def within(benchmark: BenchmarkFixture, seconds: float) -> None:
    """Fail when the median took longer; a suite run for correctness measures nothing."""
    if benchmark.enabled:
        median = benchmark.stats.stats.median
        assert median < seconds, f"{median * 1e3:.2f} ms, the budget is {seconds * 1e3:g} ms"
