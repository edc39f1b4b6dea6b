"""Factors over strain from strain sweeps."""

import numpy as np
import pytest

import asperity
from asperity import StrainSweep, strain_factors
from helpers.measured import present


def sweep(strain, storage, loss, frequency=60.0):
    return StrainSweep(
        temperature=293.0,
        angular_frequency=frequency,
        strain=strain,
        storage_modulus=storage,
        loss_modulus=loss,
    )


SLOW = sweep([1e-3, 1e-2, 1e-1, 1.0], [8e6, 6e6, 4e6, 2e6], [8e5, 1e6, 9e5, 5e5])
FAST = sweep([1e-3, 1e-2, 1e-1], [9e6, 8e6, 5e6], [2e6, 2.2e6, 1.8e6], 600.0)


def test_one_sweep_over_its_lowest_strain():
    made = strain_factors([SLOW])
    np.testing.assert_array_equal(made.strain, SLOW.strain)
    np.testing.assert_allclose(made.storage, SLOW.storage_modulus / 8e6, rtol=1e-14)
    np.testing.assert_allclose(made.loss, SLOW.loss_modulus / 8e5, rtol=1e-14)
    assert made.storage_error is None
    assert made.notes == ()


def test_a_reference_between_rows_is_interpolated():
    made = strain_factors([SLOW], reference_strain=np.sqrt(1e-5))
    assert (made.strain[0], made.storage[0], made.loss[0]) == (np.sqrt(1e-5), 1, 1)
    np.testing.assert_allclose(made.storage[1:], [np.sqrt(6 / 8), 4 / np.sqrt(48), 2 / np.sqrt(48)])


def test_several_sweeps_have_one_mean_and_go_on_where_one_ends():
    made = strain_factors([SLOW, FAST])
    np.testing.assert_allclose(
        made.storage[:3], [1, np.sqrt(6 / 8 * 8 / 9), np.sqrt(4 / 8 * 5 / 9)], rtol=1e-14
    )
    np.testing.assert_allclose(made.storage[3] / made.storage[2], 2 / 4, rtol=1e-14)
    apart = np.log((6 / 8) / (8 / 9)) / np.sqrt(2)
    assert made.storage_error[1] == pytest.approx(abs(apart), rel=1e-12)
    assert made.storage_error[3] == made.storage_error[2]
    (note,) = made.notes
    assert note.code == "strain-sweeps-differ"
    assert strain_factors([FAST, SLOW]) == made


@pytest.mark.parametrize(
    ("sweeps", "reference", "error"),
    [
        ([], None, asperity.InvalidInput),
        ([SLOW], 1e-4, asperity.OutOfRange),
        ([SLOW], 1.0, asperity.OutOfRange),
        ([SLOW, FAST], 0.5, asperity.OutOfRange),
        ([SLOW, sweep([2.0, 3.0], [1e6, 1e6], [1e5, 1e5])], None, asperity.InvalidInput),
    ],
)
def test_refused(sweeps, reference, error):
    with pytest.raises(error):
        strain_factors(sweeps, reference_strain=reference)


@pytest.mark.parametrize("name", ["material_a", "epdm_70"])
def test_measured_rubbers_soften(name):
    columns = {
        "frequency": "freq_hz",
        "temperature": "temperature_C",
        "storage": "G_storage_pa",
        "loss": "G_loss_pa",
        "strain": "strain_dyn_pct",
    }
    units = {"frequency": "Hz", "temperature": "C", "modulus": "Pa", "strain": "%"}
    made = strain_factors(
        [
            asperity.read_strain_sweep(
                present("dma", name, f"sd_{hertz}hz.csv"), columns=columns, units=units, modulus="G"
            )
            for hertz in (10, 100)
        ],
        reference_strain=0.0015,
    )
    assert 0.5 < made.storage[-1] < 0.9
    assert made.strain[-1] > 0.01
    assert (made.storage > 0).all()
    assert (made.loss > 0).all()
