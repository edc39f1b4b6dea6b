"""modelDescription.xml of FMI 2.0 and 3.0, after the schemas of the standards."""

from collections.abc import Sequence
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

from asperity import _core
from asperity.fmu.variables import TIME, Variable, scalars

_DESCRIPTION = "Rubber friction over pressure and velocity, looked up in a certified map"
_UNITS = {
    "Pa": {"kg": 1, "m": -1, "s": -2},
    "m/s": {"m": 1, "s": -1},
    "m": {"m": 1},
    "K": {"K": 1},
    "rad": {"rad": 1},
}
_ABLE = {
    "canHandleVariableCommunicationStepSize": "true",
    "canNotUseMemoryManagementFunctions": "true",
    "canSerializeFMUstate": "true",
    "canGetAndSetFMUstate": "true",
    "providesDirectionalDerivative": "true",
}
_ABLE_3 = {
    "canHandleVariableCommunicationStepSize": "true",
    "canGetAndSetFMUState": "true",
    "canSerializeFMUState": "true",
    "providesDirectionalDerivatives": "true",
}
_COMPUTED = ("output", "calculatedParameter")
_VARIABILITY = {"parameter": "tunable", "calculatedParameter": "fixed"}


def description(
    fmi: str,
    name: str,
    token: str,
    variables: Sequence[Variable],
    points: int | None,
    platforms: Sequence[str],
) -> bytes:
    """The whole file; `platforms` are those of which there are binaries beside it."""
    root = Element("fmiModelDescription", {"fmiVersion": fmi, "modelName": name})
    root.set("guid" if fmi == "2.0" else "instantiationToken", token)
    binaries = f"binaries for {' and '.join(platforms)}, " if platforms else ""
    root.set("description", f"{_DESCRIPTION}; {binaries}source for any platform")
    root.set("generationTool", f"asperity {_core.__version__}")
    root.set("variableNamingConvention", "structured")
    able = _ABLE if fmi == "2.0" else _ABLE_3
    simulation = SubElement(root, "CoSimulation", {"modelIdentifier": name, **able})
    if fmi == "2.0":
        SubElement(SubElement(simulation, "SourceFiles"), "File", {"name": "fmu.cpp"})
    definitions = SubElement(root, "UnitDefinitions")
    for unit, powers in {**_UNITS, "s": {"s": 1}}.items():
        one = SubElement(definitions, "Unit", {"name": unit})
        SubElement(one, "BaseUnit", {base: str(power) for base, power in powers.items()})
    categories = SubElement(root, "LogCategories")
    for category in ("logStatusWarning", "logStatusError"):
        SubElement(categories, "Category", {"name": category})
    SubElement(root, "DefaultExperiment", {"startTime": "0", "stopTime": "1", "stepSize": "0.001"})
    (_version_2 if fmi == "2.0" else _version_3)(root, tuple(variables), points)
    return _text(root)


def _text(root: Element) -> bytes:
    ElementTree.indent(root)
    text: bytes = ElementTree.tostring(root, encoding="utf-8", xml_declaration=True)
    return text + b"\n"


def build_description(name: str) -> bytes:
    """sources/buildDescription.xml of FMI 3.0: how the binaries are made."""
    root = Element("fmiBuildDescription", {"fmiVersion": "3.0"})
    configuration = SubElement(root, "BuildConfiguration", {"modelIdentifier": name})
    files = SubElement(configuration, "SourceFileSet", {"language": "C++17"})
    SubElement(files, "SourceFile", {"name": "fmu.cpp"})
    return _text(root)


def _version_2(root: Element, variables: tuple[Variable, ...], points: int | None) -> None:
    listed = SubElement(root, "ModelVariables")
    index: dict[tuple[str, int], int] = {}
    for i, (variable, full_name, reference, point) in enumerate(scalars(variables, points)):
        index[variable.name, point if variable.each_point else 0] = i + 1
        one = SubElement(listed, "ScalarVariable", {"name": full_name})
        one.set("valueReference", str(reference))
        _common(one, variable)
        kind = SubElement(one, variable.kind.capitalize())
        if variable.unit is not None:
            kind.set("unit", variable.unit)
        if variable.start is not None:
            kind.set("start", _written(variable.start))
    structure = SubElement(root, "ModelStructure")
    outputs = SubElement(structure, "Outputs")
    initial = SubElement(structure, "InitialUnknowns")
    by_name = {variable.name: variable for variable in variables}
    for (of, point), number in sorted(index.items(), key=lambda item: item[1]):
        variable = by_name[of]
        needed = [
            index[other, point if by_name[other].each_point else 0] for other in variable.depends_on
        ]
        unknown = {"index": str(number), "dependencies": " ".join(map(str, sorted(needed)))}
        if variable.causality == "output":
            SubElement(outputs, "Unknown", unknown)
        if variable.causality in _COMPUTED:
            SubElement(initial, "Unknown", unknown)


def _version_3(root: Element, variables: tuple[Variable, ...], points: int | None) -> None:
    listed = SubElement(root, "ModelVariables")
    time = {"name": "time", "valueReference": str(TIME), "causality": "independent"}
    SubElement(listed, "Float64", {**time, "variability": "continuous", "unit": "s"})
    kinds = {"real": "Float64", "integer": "Int32", "boolean": "Boolean"}
    for variable in variables:
        one = SubElement(listed, kinds[variable.kind], {"name": variable.name})
        one.set("valueReference", str(variable.reference))
        _common(one, variable)
        if variable.unit is not None:
            one.set("unit", variable.unit)
        array = points is not None and variable.each_point
        if variable.start is not None:
            one.set("start", " ".join([_written(variable.start)] * (points or 1 if array else 1)))
        if array:
            SubElement(one, "Dimension", {"start": str(points)})
    structure = SubElement(root, "ModelStructure")
    references = {variable.name: str(variable.reference) for variable in variables}
    for tag, causalities in (("Output", ("output",)), ("InitialUnknown", _COMPUTED)):
        for variable in variables:
            if variable.causality in causalities:
                needed = " ".join(references[other] for other in variable.depends_on)
                unknown = {"valueReference": references[variable.name], "dependencies": needed}
                SubElement(structure, tag, unknown)


def _common(one: Element, variable: Variable) -> None:
    one.set("causality", variable.causality)
    usual = "continuous" if variable.kind == "real" else "discrete"
    one.set("variability", _VARIABILITY.get(variable.causality, usual))
    if variable.causality in _COMPUTED:
        one.set("initial", "calculated")
    one.set("description", variable.description)


def _written(start: float | bool) -> str:
    return str(start).lower() if isinstance(start, bool) else repr(float(start))
