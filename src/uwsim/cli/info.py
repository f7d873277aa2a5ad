"""``uwsim info``: the content of a scene."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from rich.console import RenderableType
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from ..assets.bundled import benchmark_file, scene_file
from ..base.terminal import clean_text
from ..checks import check_file
from ..errors import ErrorCollector
from ..runs.planning.option_values import pairs_of
from .options.options import (
    DataPathOption,
    JsonOption,
    SceneArgument,
    SetOption,
    XacroOption,
    xacro_settings,
)
from .output.console import standard_output

DRAG_LAWS = {
    "axes": "by each component's own speed",
    "speed": "by the speed of all three components",
    "x": "by the speed across the x axis",
    "y": "by the speed across the y axis",
    "z": "by the speed across the z axis",
    "matrix": "by a full matrix",
}
"""The description of each value of ``dragLaw`` in a hydrodynamics file."""
COLUMNS = 160
"""The width of the output if it is not written to a terminal [characters]."""
Fields = Mapping[str, Any]


def info(
    scene: SceneArgument,
    settings: SetOption = None,
    xacro: XacroOption = None,
    as_json: JsonOption = False,
    data_path: DataPathOption = None,
) -> None:
    """Show the content of a scene: vehicles, cameras, sensors, topics, services, water, floor.

    For the name of a bundled benchmark: its scene, levels, measures, success and failures.

    Positions are in the file's frame, as in the file and on topics, in metres and radians. The
    floor is the surface straight below each vehicle's origin. Elements that are read and not
    simulated are listed last.
    """
    from ..physics.compile_scene import compile_scene
    from ..scene.reader import read_scene
    from ..scene.settings import apply_setting, xacro_arguments
    from ..simulation import Simulation
    from .output.benchmark_inventory import benchmark_inventory, is_benchmark
    from .output.inventory import inventory

    if is_benchmark(scene):
        benchmark = benchmark_inventory(benchmark_file(scene))
        print_parts(benchmark, benchmark_parts(benchmark), as_json=as_json)
        return
    folders = tuple(data_path or ())
    path = scene_file(scene, folders)
    errors = ErrorCollector()
    pairs = pairs_of([*(settings or ()), *xacro_settings(xacro)], errors)
    arguments = xacro_arguments(pairs)
    spec = read_scene(path, data_path=folders, arguments=arguments)
    for name, value in pairs:
        with errors.collect():
            spec = apply_setting(spec, name, value)
    errors.raise_errors()
    simulation = Simulation(
        compile_scene(spec.nominal_scene, data_path=folders), is_blind=True, runs_code=False
    )
    try:
        content = inventory(
            spec, simulation, check_file(path, data_path=folders, arguments=arguments)
        )
    finally:
        simulation.close()
    print_parts(content, render_parts(content), as_json=as_json)


def print_parts(content: Fields, parts: Iterable[RenderableType], *, as_json: bool) -> None:
    """Print a content as JSON or as text."""
    if as_json:
        print(json.dumps(content, indent=1))
        return
    console = standard_output(COLUMNS)
    for part in parts:
        console.print(part)


def benchmark_parts(content: Fields) -> Iterator[RenderableType]:
    """Yield the sections of the output for a benchmark."""
    yield Text(clean_text(str(content["file"])), style="bold")
    yield from _section(
        "scene", [f"{content['scene']}; its vehicles and topics: uwsim info {content['scene']}"]
    )
    yield from _section("algorithm", [content["algorithm"]])
    levels = [
        f"{name}: {', '.join(values)}" + _unit_text(content["units"].get(name, "1"))
        for name, values in content["levels"].items()
    ]
    yield from _section(f"levels ({content['n_levels']})", levels)
    measures = [f"{name} ({kind})" for name, kind in content["measures"].items()]
    yield from _section("measures", measures)
    yield from _section("score, lower is better", [content["score"]])
    if content["success"]:
        failures = [f"{status}: {text}" for status, text in content["failures"].items()]
        yield from _section("outcome", [f"ok: {content['success']}", *failures])
    if content["varies"]:
        yield from _section("differs from seed to seed, besides the scene", content["varies"])
    observations = [f"{name}: {', '.join(v)}" for name, v in content["observations"].items()]
    if observations:
        yield from _section("observation of a policy, by vehicle", observations)


def render_parts(content: Fields) -> Iterator[RenderableType]:
    """Yield the sections and tables of the output."""
    yield Text(clean_text(str(content["file"])), style="bold")
    yield from _section("frame and water", [_frame(content["frame"]), *_water(content["water"])])
    for vehicle in content["vehicles"]:
        yield from _section(f"vehicle {vehicle['name']}", _vehicle(vehicle))
    yield from _table("cameras", map(_camera, content["cameras"]))
    yield from _table("sensors and lamps that point somewhere", map(_sensor, content["sensors"]))
    yield from _table("objects", map(_object, content["objects"]))
    if content["tethers"]:
        yield from _section("tethers", map(_tether, content["tethers"]))
    yield from _table("topics", map(_topic, content["topics"]))
    services = ", ".join(content["services"]) or "none of the scene's own"
    yield from _section(
        "services", [f"{services}; a benchmark offers startBench, stopBench and what it names"]
    )
    if content["varies"]:
        yield from _section("differs from seed to seed", map(_variation, content["varies"]))
    yield from _section("read, not simulated", content["not_simulated"])
    if content["warnings"]:
        yield from _section("warnings of uwsim check", content["warnings"])


def _variation(variation: Fields) -> str:
    return f"{variation['path']}: {variation['drawn_from']}{_unit_text(variation['unit'])}"


def _unit_text(unit: str) -> str:
    return "" if unit in ("", "1") else f" {unit}"


def _tether(tether: Fields) -> str:
    ends = [end if isinstance(end, str) else f"{_format_numbers(end)} m" for end in tether["ends"]]
    length = f"{tether['length']:g} m in {tether['segments']} segments"
    winch = "" if tether["max_length"] is None else f", winch up to {tether['max_length']:g} m"
    load = "" if tether["break_load"] is None else f", breaks at {tether['break_load']:g} N"
    return f"{tether['name']}: from {ends[0]} to {ends[1]}, {length}{winch}{load}"


def _section(title: str, lines: Iterable[str]) -> Iterator[RenderableType]:
    yield Text(clean_text(f"\n{title}"), style="bold")
    for line in list(lines) or ["nothing"]:
        yield Padding(Text(clean_text(line)), (0, 0, 0, 2), expand=False)


def _table(title: str, rows: Iterator[Sequence[str]]) -> Iterator[RenderableType]:
    cells = [tuple(map(clean_text, row)) for row in rows]
    if not cells:
        yield from _section(title, [])
        return
    yield Text(f"\n{title}", style="bold")
    table = Table(box=None, show_header=False, padding=(0, 2, 0, 0), pad_edge=False)
    for _ in cells[0]:
        table.add_column(overflow="fold")
    for row in cells:
        table.add_row(*map(Text, row))
    yield Padding(table, (0, 0, 0, 2), expand=False)


def _frame(frame: Fields) -> str:
    up = frame["up"] if isinstance(frame["up"], str) else f"along {_format_numbers(frame['up'])}"
    return f"up is {up} in the file's frame; offset {_format_numbers(frame['offset'])} m"


def _water(water: Fields) -> list[str]:
    attenuation = _format_numbers(water["attenuation"])
    return [
        f"surface through {_format_numbers(water['surface_above_origin'])} m, "
        f"{', '.join(map(_wave, water['waves'])) or 'level'}",
        *(
            [f"fog {water['fog_density']:g} 1/m; attenuation (red, green, blue) {attenuation} 1/m"]
            if water["physical"] is None
            else _physical_water(water["physical"])
        ),
        f"currents: {', '.join(water['currents']) or 'none'}",
    ]


def _wave(wave: Fields) -> str:
    name = "height" if wave["kind"] == "regularWave" else "significant height"
    period = "" if wave["period"] is None else f", period {wave['period']:.3g} s"
    return f"{wave['kind']} of {name} {wave['height']:.3g} m{period}"


def _physical_water(water: Fields) -> Iterator[str]:
    coefficients = (
        f"absorption (red, green, blue) {_format_numbers(water['absorption'])} 1/m, "
        f"scattering {_format_numbers(water['scattering'])} 1/m"
    )
    yield f"physical water {water['source']}: {coefficients}"
    sun, wind = water["sun"], water["ripples_wind"]
    light = (
        f"sun {sun['elevation']:.3g} rad high, irradiance {sun['irradiance']:g}"
        if sun["irradiance"] > 0.0
        else "no sun"
    )
    yield f"{light}; {'no ripples' if wind is None else f'ripples of a wind of {wind:g} m/s'}"
    if water["particles"]:
        yield f"particles: {', '.join(water['particles'])}"


def _vehicle(vehicle: Fields) -> list[str]:
    lines = [
        f"{vehicle['file']} at {_format_numbers(vehicle['position'])} m, "
        f"turned {_format_numbers(vehicle['orientation'])} rad; {vehicle['moves']}",
        f"below it: {_surfaces_below(vehicle['below'])}",
        f"thrusters: {', '.join(vehicle['thrusters']) or 'none that are simulated'}",
        *_fins(vehicle["fins"]),
        f"links: {', '.join(vehicle['links'])}",
        *_drag(vehicle["drag_laws"]),
    ]
    lines += [f"joint {_joint(joint)}" for joint in vehicle["joints"]]
    return lines


def _fins(fins: Sequence[Fields]) -> Iterator[str]:
    texts = [f"{fin['name']} ({fin['limits'][0]:g} to {fin['limits'][1]:g} rad)" for fin in fins]
    if texts:
        yield f"fins: {', '.join(texts)}"


def _drag(laws: Mapping[str, str]) -> Iterator[str]:
    for law, words in DRAG_LAWS.items():
        if links := [link for link, link_law in laws.items() if link_law == law]:
            yield f"quadratic drag {words}: {', '.join(links)}"


def _surfaces_below(surfaces: Sequence[Fields]) -> str:
    messages = [
        f"{surface['name']} {surface['distance']:.4g} m down, "
        f"at {_format_numbers(surface['position'])} m"
        for surface in surfaces
    ]
    return "; ".join(messages) or "nothing: there is no floor there"


def _joint(joint: Fields) -> str:
    limits = "no end stops"
    if joint["lower"] is not None:
        limits = f"{joint['lower']:g} to {joint['upper']:g} {joint['unit']}"
    return f"{joint['name']}: {joint['kind']}, {limits}" + (
        f", follows {joint['mimics']}" if joint["mimics"] else ""
    )


def _camera(camera: Fields) -> tuple[str, ...]:
    field = "own matrix" if camera["fovy_deg"] is None else f"{camera['fovy_deg']:g}° high"
    return (
        camera["name"],
        f"{camera['vehicle']}/{camera['link']}",
        f"{camera['width']}x{camera['height']} px, {field}, noise {camera['std']:g}",
        ", ".join(camera["topics"]) or "on no topic",
    )


def _sensor(sensor: Fields) -> tuple[str, ...]:
    place = f"{sensor['vehicle']}/{sensor['link']}"
    return sensor["name"], f"<{sensor['kind']}>", place, sensor["points"]


def _object(entry: Fields) -> tuple[str, ...]:
    return entry["name"], entry["file"], f"at {_format_numbers(entry['position'])} m", entry["kind"]


def _topic(topic: Fields) -> tuple[str, ...]:
    rate = f" at {topic['rate_hz']:g} Hz" if topic["rate_hz"] else ""
    content = topic["limit"] or topic["type"] or ""
    return topic["topic"], f"{topic['direction']}{rate}", content, topic["of"], topic["interface"]


def _format_numbers(values: Sequence[float]) -> str:
    return "(" + ", ".join(f"{value:.4g}" for value in values) + ")"
