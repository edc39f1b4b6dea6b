"""The codes of notes and errors, which stay: severity and meaning, from which the page on them is
made. A test holds them to what the core and the package say."""

from typing import NamedTuple

FATAL, WARNING, NOTE = "fatal", "warning", "note"

NOTES = {
    # the surface
    "slope-unmeasured": (FATAL, "most of the slope is of waves that the scan holds too few of"),
    "slope-not-reached": (FATAL, "the scan ends before the slope that was to end the spectrum"),
    "scan-length-as-q0": (FATAL, "the scan's length was taken for that of macro-asperities"),
    "steep-spectrum": (WARNING, "the rms slope is above 1.3: mu rests on the choice of q1"),
    "near-nyquist": (WARNING, "roughness below the pixel is folded into the last rows"),
    "noise-in-spectrum": (WARNING, "noise of the instrument is half of the last rows or more"),
    "heights-not-gaussian": (WARNING, "the spectrum does not know that tops are worn or peaked"),
    "gathered-waves": (
        WARNING,
        "the spectrum does not know that short waves are gathered in places",
    ),
    "worn-line-scan": (WARNING, "a line does not tell what roughness rubber meets on worn tops"),
    "lines-in-spectrum": (WARNING, "a machined surface: its roughness is no random one"),
    "lay": (WARNING, "the surface is rougher in one direction"),
    "few-long-waves": (WARNING, "the scan holds few of its longest waves"),
    "few-periods": (WARNING, "long waves were measured a few times only"),
    "law-beyond-rows": (WARNING, "the spectrum is the fitted law beyond the reliable rows"),
    "line-scan": (NOTE, "the spectrum is that of the isotropic surface with such profiles"),
    "no-cutoff": (NOTE, "a slope of 1.3 does not end this spectrum"),
    "reliable-band": (NOTE, "which rows of the spectrum are reliable"),
    "no-self-affine-fit": (NOTE, "why there is no self-affine fit"),
    "scan-in-parts": (NOTE, "short waves are solved on parts of the scan"),
    "scan-interpolated": (NOTE, "the scan was interpolated to finer points"),
    "map-continued": (NOTE, "how the map was made periodic"),
    # the rubber
    "undetermined-shift": (FATAL, "the moduli do not tell how far an isotherm is to be shifted"),
    "moduli-disagree": (WARNING, "E' and E'' disagree by some per cent, as many published ones do"),
    "moduli-contradict": (FATAL, "E' and E'' belong to no one material"),
    "modulus-extrapolated": (FATAL, "most of the hysteresis is of frequencies never measured"),
    "modulus-unmeasured": (WARNING, "a part of the hysteresis is of frequencies never measured"),
    "beyond-prony-fit": (WARNING, "the series is asked beyond the rows it was fitted to"),
    "different-shifts": (WARNING, "E' alone and E'' alone ask for different shifts"),
    "isotherms-off-curve": (WARNING, "isotherms lie off the master curve as a whole"),
    "points-off-curve": (WARNING, "many points lie off the master curve"),
    "small-overlap": (WARNING, "isotherms have little modulus in common"),
    "law-beyond-fit": (WARNING, "the law of the shift is used beyond its temperatures"),
    "point-off-curve": (NOTE, "a point lies off the master curve"),
    "no-vertical-shift": (WARNING, "what a vertical shift would change"),
    "isotherms-merged": (NOTE, "isotherms of one temperature were taken as one"),
    "rows-averaged": (NOTE, "rows of one frequency were averaged"),
    "shifts-relative": (NOTE, "shift factors of a file are 1 at another temperature"),
    "ramp-cut": (NOTE, "the ends of a temperature ramp tell no shift"),
    "rows-left-out": (NOTE, "rows of a file belong to another test"),
    "strain-sweeps-differ": (NOTE, "how far strain sweeps of one rubber differ"),
    "strain-beyond-sweeps": (WARNING, "a part of the hysteresis is of strains never measured"),
    "strain-ratios-held": (NOTE, "strain sweeps do not reach as far as the master curve"),
    "wlf-fit": (NOTE, "how well the shift factors follow WLF"),
    "no-wlf-fit": (NOTE, "why there is no WLF fit"),
    "no-prony-fit": (NOTE, "why there is no Prony fit"),
    # the contact
    "full-conformity": (FATAL, "Greenwood-Williamson: the separation is below the lowest point"),
    "separation-too-large": (FATAL, "Greenwood-Williamson: the area does not fall with the load"),
    "no-contact": (FATAL, "Greenwood-Williamson: the separation is above the highest point"),
    "area-further-off": (FATAL, "the affine shift makes the area worse"),
    "no-correction": (WARNING, "plain theory, which exact contacts show to be off"),
    "unmeasured-bandwidth": (NOTE, "the correction was not measured at such a bandwidth"),
    "unmeasured-load": (NOTE, "the correction was not measured at such a light load"),
    "unknown-model-error": (NOTE, "no exact contact was solved near these points"),
    "coarse-map": (WARNING, "contacts of few pixels are uncertain"),
    "along-x": (NOTE, "x is slid along, as without a direction, on a surface with a lay"),
    "large-angle": (WARNING, "a direction of more than a turn: it is in radians"),
    "held-ratio": (NOTE, "slopes hold the ratio of a scan's contact to PartialContact"),
    "regime-slow": (NOTE, "the model error where the loss rises with frequency"),
    "regime-constant": (NOTE, "the model error at about constant loss tangents"),
    "regime-fast": (NOTE, "the model error where the modulus outgrows the loss"),
    # friction, heat, adhesion
    "small-friction": (FATAL, "mu is below 1e-4, less than rubber has on anything rough"),
    "large-friction": (FATAL, "mu is above 4, more than rubber has on clean glass"),
    "heat-left-out": (WARNING, "flash heating changes mu, and is not in it"),
    "hot-rubber": (WARNING, "a rise of more than 100 K, beyond published experiments"),
    "several-states": (WARNING, "the heat has more than one steady state"),
    "macro-wavenumber-held": (WARNING, "the wavenumber of contacts is beyond the spectrum"),
    "maximum-extrapolated": (WARNING, "the maximum of the adhesion is at no measured velocity"),
    "systematic-misfit": (WARNING, "Eq. 23 does not fit the points"),
    "no-better-than-mean": (WARNING, "the same mu everywhere predicts the points as well"),
    "prior-stays": (NOTE, "the points tell less of a number than was known before"),
    "few-points": (WARNING, "few points: standard errors are too small"),
    "large-scatter": (WARNING, "the points scatter far about the fit"),
    "linear-band-off": (WARNING, "mu curves too much within the errors for a linear band"),
    "failed-draws": (WARNING, "the band leaves out draws that failed"),
    "map-error-exceeded": (WARNING, "random points of a map are beyond its error"),
    "little-heat-left-out": (NOTE, "flash heating changes mu little"),
    "heat-flows-sideways": (NOTE, "a slow contact: the rise is some per cent too high"),
    "crowded-contacts": (NOTE, "contacts touch, and heat one another"),
    "points-aside": (NOTE, "points were put aside as outliers"),
    "width-at-zero": (NOTE, "the width of the adhesion was taken as 0"),
    "no-adhesion": (NOTE, "why there is no fit of the adhesion"),
    "adhesion-replaced": (NOTE, "the fitted adhesion replaces the scene's"),
    "other-pressures": (NOTE, "points were measured at other pressures than the scene's"),
    "fewer-velocities": (NOTE, "some of the scene's velocities are solved"),
    "side-of-map": (NOTE, "how far a map goes about the one point of a scene"),
    # numbers whose unit makes them unlikely
    "absurd-value": (WARNING, "a number that no rubber, road or test rig has"),
    "absurd-heights": (WARNING, "heights far above the length of the scan"),
    "absurd-pressure": (WARNING, "a pressure far above the modulus"),
    "unusual-value": (WARNING, "a number that is unusual for its unit"),
    "unusual-heights": (WARNING, "heights that are unusual for the length of the scan"),
    "squashed-rubber": (WARNING, "a pressure above the largest modulus"),
}

ERRORS = {
    "error": "any other",
    "invalid-input": "`argument` cannot be used as it is; the text says why",
    "invalid-value": "`argument` is `value`, which is not `allowed`",
    "too-few-entries": "`argument` has too few entries",
    "unequal-lengths": "two arguments must be equally long",
    "other-unit": "a file states another unit than was declared",
    "unknown-columns": "no line of a file names the columns",
    "temperature-ramp": "a temperature ramp at so few frequencies does not tell how it shifts",
    "absurd-value": "a number that no rubber, road or test rig has in this unit",
    "absurd-heights": "heights far above the length of the scan",
    "absurd-pressure": "a pressure far above the modulus",
    "no-common-band": "scan and spectrum have no waves in common",
    "no-contact": "there is no contact at this point by the model",
    "no-adhesion-left": "the hysteresis alone is above the measured friction",
    "undetermined": "the points do not determine what is to be fitted",
    "out-of-range": "asked outside of what was measured",
    "unknown-modulus": "velocity and band ask for the modulus at frequencies not measured",
    "unknown-hot-modulus": "heated, the rubber is asked for a modulus that was not measured",
    "too-hot": "the rubber heats itself above what it stands",
    "outside-map": "a point is outside of what the map covers",
    "unknown-shift": "a_T is not known at this temperature",
    "not-converged": "a tolerance was not reached",
}


class Kind(NamedTuple):
    """What is declared of the notes of one code."""

    severity: str
    meaning: str
    next_step: str  # where a note brings none of its own
    effect: float  # relative change of mu that it may stand for, where a note does not know it


# Of every fatal note and every warning of the package; those of the core bring theirs.
_NEXT_STEPS = {
    "slope-not-reached": "measure with finer pixels, or go on beyond the scan by fit",
    "noise-in-spectrum": "end the spectrum where the noise begins",
    "worn-line-scan": "measure a map, whose contact ScanContact takes",
    "law-beyond-rows": "measure with finer pixels, or state it with mu",
    "law-beyond-fit": "measure the modulus at these temperatures",
    "lines-in-spectrum": "measure friction along and across the lines",
    "coarse-map": "take a finer map, or one without its shortest waves",
    "small-friction": "check the units of the heights, the modulus and the pressure",
    "no-better-than-mean": "measure over more decades of velocity, or check the scene",
    "linear-band-off": 'take method = "draws"',
    "failed-draws": "truncate the spectrum, or leave out velocities, at whose ends draws fail",
    "map-error-exceeded": "make the map anew with a smaller rtol",
    "absurd-value": "check the unit of the number",
    "absurd-heights": "check the unit of the heights",
    "absurd-pressure": "check the units of pressure and moduli",
    "unusual-value": "check the unit of the number",
    "unusual-heights": "check the unit of the heights",
    "squashed-rubber": "check the units of pressure and moduli",
}
# mu of exact contacts of worn and peaked maps is 0.1 to 2.9 times that of their spectra
# (docs/notes/sliding.md); half a decade of a_T has halved mu at 1 m/s (docs/howto/fatal_notes.md);
# a doubled q1 beyond a slope of 1.3 raises that of the README's road by 0.4 to 0.7.
_EFFECTS = {
    "heights-not-gaussian": 1.0,
    "gathered-waves": 0.4,
    "worn-line-scan": 1.0,
    "different-shifts": 0.5,
    "no-vertical-shift": 0.5,
    "steep-spectrum": 0.5,
    "no-correction": 0.39,
    "heat-left-out": 0.2,
}
_OF_SEVERITY = {FATAL: 1.0, WARNING: 0.05, NOTE: 0.0}

KINDS = {
    code: Kind(
        severity,
        meaning,
        _NEXT_STEPS.get(code, ""),
        _EFFECTS.get(code, _OF_SEVERITY[severity]),
    )
    for code, (severity, meaning) in NOTES.items()
}
