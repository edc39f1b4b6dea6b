"""Vector units of two widths compute the same bits."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

SWEEP = """
import json, sys
import numpy as np
import asperity

road = asperity.SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000, q1=1e6)
q = np.geomspace(2e3, 1e6, 60)
density = road.at(q) * np.where(np.arange(60) % 13 == 7, 0, 1 + np.sin(9 * q))
scan = asperity.TabulatedSpectrum(wavenumber=q, density=density)
w = np.geomspace(1e-2, 1e8, 21)
rubbers = [
    asperity.PronySeries(
        equilibrium_modulus=3e6,
        moduli=np.geomspace(1e9, 1e6, n),
        relaxation_times=np.geomspace(1e-9, 1e0, n),
    )
    for n in (1, 2, 3, 4, 5, 20, 57)
]
rubbers.append(
    asperity.MasterCurve(
        angular_frequency=w, storage_modulus=1e6 * (1 + w**0.35), loss_modulus=3e5 * w**0.3
    )
)
corrections = [None, asperity.SFactor(applies_to="both"), asperity.NayakSFactor()]
corrections += [asperity.AffineShift(2), asperity.PartialContact()]
corrections += [asperity.GreenwoodWilliamson(z_max=9e-4, z_min=-9e-4)]
found = []
for spectrum in (road, scan):
    for rubber in rubbers:
        for correction in corrections:
            for form in ("exact", "interpolated"):
                if form != "exact" and isinstance(correction, asperity.PartialContact):
                    continue
                for rtol in (1e-3, 1e-6, 1e-9):
                    result = asperity.friction(
                        spectrum,
                        rubber,
                        pressure=[1e3, 81e3, 1e7],
                        velocity=np.geomspace(1e-4, 1, 3)[:, None],
                        correction=correction,
                        form=form,
                        rtol=rtol,
                    )
                    for column in (result.mu, result.contact_area, result.error_estimate):
                        found += [x.hex() for x in np.ravel(column).tolist()]
json.dump(found, sys.stdout)
"""


def sweep(vectors, **more):
    environment = {**os.environ, "ASPERITY_VECTORS": vectors, **more}
    run = [sys.executable, "-c", SWEEP]
    done = subprocess.run(run, env=environment, capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def test_narrow_and_wide_vectors_give_the_same_bits():
    cpu = Path("/proc/cpuinfo")
    if not (cpu.exists() and " avx2 " in cpu.read_text()):
        pytest.skip("this machine has no AVX2 to compare with, or does not say so")
    narrow, wide = sweep("baseline"), sweep("avx2")
    assert len(narrow) == 2 * 8 * (5 * 2 + 1) * 3 * 9 * 3
    assert narrow == wide


def test_an_older_c_library_changes_the_last_digits_alone():
    # exp, log and pow of glibc without fused multiply-add, as x86-64 v1 has them
    old = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-AVX512F,-AVX2_Usable,-FMA_Usable"}
    ours, theirs = (
        np.array([float.fromhex(x) for x in found]).reshape(-1, 3, 9)
        for found in (sweep("baseline"), sweep("baseline", **old))
    )
    # 8e-16 of mu and 9e-16 of the area, measured
    np.testing.assert_allclose(theirs[:, :2], ours[:, :2], rtol=1e-14)
    # the estimate is made of differences of numbers as large as mu: 2e-8 of it, or 3e-15 in itself
    np.testing.assert_allclose(theirs[:, 2], ours[:, 2], rtol=1e-6, atol=1e-14)


def test_other_vectors_are_refused():
    with pytest.raises(subprocess.CalledProcessError) as caught:
        sweep("avx9")
    assert "ASPERITY_VECTORS = avx9: must be baseline or avx2" in caught.value.stderr
