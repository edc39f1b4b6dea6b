"""Tables of scene files, which several tests share, and what Python's functions make of them."""

import asperity

SURFACE = """
[surface]
rms_height_m = 76.572e-6
hurst = 0.7
q0_per_m = 2000.0
q1_per_m = 1e5
"""
SCAN = """
[surface]
file = "scan.npy"
pixel_size_m = [2e-5, 1e-5]
unit = "um"
"""
RUBBER = """
[rubber]
equilibrium_modulus_pa = 2e6
moduli_pa = [1e9, 1e8, 1e7]
relaxation_times_s = [1e-8, 1e-6, 1e-4]
"""
CURVE = """
[rubber]
master_curve = "curve.csv"
"""
CONDITIONS = """
[conditions]
pressure_pa = [81e3, 2e5]
velocity_m_s = {from = 1e-4, to = 1, points = 5}
"""
ADHESION = """
[adhesion]
shear_stress_pa = 8.3e6
"""
LAW = "\nwlf_c1 = 8.86\nwlf_c2_k = 101.6\nreference_temperature_k = 293.15\n"
HEATING = """
[heating]
density_kg_m3 = 1200
heat_capacity_j_kg_k = 1650
conductivity_w_m_k = 0.23
contact_diameter_m = 1e-3
"""
SCENE = SURFACE + RUBBER + CONDITIONS + ADHESION


def by_python(scene, **more):
    """Friction of the parts of a scene at its points, flat, with more or other arguments."""
    pressure, velocity = scene.points
    parts = {"spectrum": scene.spectrum, "rubber": scene.rubber}
    at = {"pressure": pressure, "velocity": velocity, "adhesion": scene.adhesion}
    return asperity.friction(**{**parts, **at, "correction": scene.correction, **more})
