"""The verb `fmu`: a friction map as a Functional Mock-up Unit."""

from argparse import Namespace

from asperity.base.arguments import FilePath
from asperity.cli.friction_commands import refuse_overwrite
from asperity.cli.map_command import read_map
from asperity.cli.streams import print_stdout
from asperity.fmu.export import PLATFORMS, export_fmu, platforms
from asperity.io.fields import rename_in_errors
from asperity.io.files import check_output


def fmu(args: Namespace) -> None:
    """Write the FMU of a map, and tell for which platforms it has binaries."""
    source, output = FilePath(args.map), FilePath(args.output)
    check_output(output)
    refuse_overwrite([output], [source])
    read = read_map(source)
    with rename_in_errors(None, {one: f"--{one}" for one in ("name", "points")}):
        export_fmu(read, output, name=args.name, fmi=args.fmi, points=args.points)
    missing = [one for one in PLATFORMS if one not in platforms()]
    lines = [f"binaries = {', '.join(platforms()) or 'none'}"]
    if missing:
        lines.append(f"from source alone = {', '.join(missing)}")
    print_stdout("".join(f"{line}\n" for line in lines))
