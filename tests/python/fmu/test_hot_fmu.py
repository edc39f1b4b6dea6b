"""An FMU of a map with heat keeps the distance slid."""

import pytest
from fmpy.validation import validate_fmu

from asperity import export_fmu
from helpers.fmus import A_T, Host, on_linux, same


@on_linux
@pytest.mark.parametrize("fmi", ["2.0", "3.0"])
def test_heat_remembers_the_distance(hot_road, tmp_path, fmi):
    export_fmu(hot_road, tmp_path / "hot.fmu", fmi=fmi)
    assert validate_fmu(str(tmp_path / "hot.fmu")) == []
    host = Host(tmp_path / "hot.fmu", tmp_path / "x")
    host.set([1, 2, 3], [2e5, 1.0, 290.0])
    at = {"pressure": 2e5, "velocity": 1.0, "temperature": 290.0}
    for i in range(5):
        assert host.get([8]) == same([hot_road.mu(**at, distance=i * 1e-3)])
        assert host.get([16]) == pytest.approx([i * 1e-3])
        host.step(i * 1e-3, 1e-3)
    assert host.get([8])[0] < hot_road.mu(**at, distance=0.0)

    host.set([2], [-1.0])  # slides back
    host.step(1.0, 2e-3)
    assert host.get([16]) == pytest.approx([2e-3])
    assert host.get([8]) == same([hot_road.mu(**at, distance=2e-3)])
    host.set([2], [0.0])
    host.step()
    assert host.get([16]) == [0.0]
    host.set([2], [1.0])
    host.step(1.0, 3e-3)
    host.unit.setBoolean([4], [True])
    host.step(1.0, 1e-3)
    assert host.get([16]) == pytest.approx([1e-3])  # the reset, and this step

    host.unit.setBoolean([27], [False])  # without memory
    assert host.get([8]) == same([hot_road.mu(**at)])
    host.set([3], [350.0])  # beyond the map
    assert host.inside() == 0
    assert host.get([8]) == same([hot_road.mu(2e5, 1.0, temperature=291.15)])
    with pytest.raises(Exception, match=r"(?i)status 3|error"):
        host.set([A_T], [2.0])  # leads from no temperature to another here
    host.end()
