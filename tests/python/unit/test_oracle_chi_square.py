import numpy as np
import pytest

from burnish.oracle.chi_square import chi_square_p_value, chi_square_test, pool_cells, sidak_level


@pytest.mark.parametrize(
    ("statistic", "degrees"), [(18.307, 10), (124.342, 100), (1074.679, 1000)], ids=["10", "100", "1000"]
)
def test_p_value_at_the_five_percent_points(statistic, degrees):
    assert chi_square_p_value(statistic, degrees) == pytest.approx(0.05, abs=5e-4)


def test_sidak_level_of_many_tests():
    assert 1 - (1 - sidak_level(0.01, 20)) ** 20 == pytest.approx(0.01)


def test_small_cells_are_pooled():
    observed, expected = pool_cells([10, 1, 0, 2, 7], [9, 0.5, 0.5, 4.5, 6])
    np.testing.assert_array_equal(expected, [5.5, 6, 9])
    np.testing.assert_array_equal(observed, [3, 7, 10])


def test_pool_that_stays_too_small_takes_in_the_next_cell():
    observed, expected = pool_cells([1, 6, 20], [1, 6, 20])
    np.testing.assert_array_equal(expected, [7, 20])
    np.testing.assert_array_equal(observed, [7, 20])


def test_false_alarms_come_as_often_as_asked_for(rng):
    chance = np.linspace(1, 3, 30) / np.sum(np.linspace(1, 3, 30))
    p = [chi_square_test(rng.multinomial(5000, chance), 5000 * chance) for _ in range(2000)]
    assert np.mean(np.array(p) < 0.05) == pytest.approx(0.05, abs=0.015)


def test_wrong_density_is_found(rng):
    chance = np.linspace(1, 3, 30) / np.sum(np.linspace(1, 3, 30))
    assert chi_square_test(rng.multinomial(5000, np.full(30, 1 / 30)), 5000 * chance) < 1e-6


def test_single_cell_is_refused():
    with pytest.raises(ValueError, match="expected: expected at least two cells after pooling, got 1"):
        chi_square_test([10], [10])


def test_observation_where_nothing_is_expected_gives_zero():
    assert chi_square_test([1, 50, 49], [0, 50, 50]) == 0
