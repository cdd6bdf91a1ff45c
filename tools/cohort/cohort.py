"""What a cohort is: its cases, where they lie, what is known of each."""

import csv
import dataclasses
import json
import os
import re
import shlex
import shutil
from pathlib import Path

SURFACE_SUFFIXES = {".stl", ".obj", ".ply", ".off", ".vtp", ".vtk"}
CASE_NAME = re.compile(r"[A-Za-z0-9_-][A-Za-z0-9_.-]*")


class CohortError(Exception):
    """The list of surfaces cannot be used; says where and why."""


@dataclasses.dataclass
class Case:
    name: str
    surface: str  # absolute path
    options: str  # of `hexwall mesh`, as on a command line
    columns: dict  # further columns of the TSV


def find_program(given, name):
    """The path of a program: as given, of this source tree's build, or of PATH."""
    if given:
        path = shutil.which(given)
        if not path:
            raise CohortError(f"there is no program {given}")
        return os.path.abspath(path)
    built = Path(__file__).resolve().parents[2] / "build" / name
    return str(built) if built.is_file() else shutil.which(name) or name


def read_cohort(surfaces, options=""):
    """The cases of a folder of surfaces, or of a TSV with a header and the column `surface`.

    `options` hold for all cases; those of a case come after them.
    """
    if surfaces.is_dir():
        cases = _cases_of_folder(surfaces)
    elif surfaces.is_file():
        cases = _cases_of_table(surfaces)
    else:
        raise CohortError(f"{surfaces} is neither a folder of surfaces nor a TSV file")
    if not cases:
        raise CohortError(f"there is no surface in {surfaces}")
    for case in cases:
        case.options = merged(options, case.options)
    return cases


def merged(*lists):
    """Options of several command lines in one: of an option that occurs twice, the last counts."""
    options = {}
    for text in lists:
        name = None
        for word in shlex.split(text):
            if word.startswith("-") and not re.match(r"-[\d.]", word):
                name = word.split("=")[0]
                options[name] = [word]
            elif name is None:
                raise CohortError(f"options begin with an option, not with '{word}'")
            else:
                options[name].append(word)
    return shlex.join(word for words in options.values() for word in words)


def write_cases(output, cases):
    """Writes `cases.json` into `output`, for those who collect results later."""
    output.mkdir(parents=True, exist_ok=True)
    path = output / "cases.json"
    text = json.dumps([dataclasses.asdict(case) for case in cases], indent=1) + "\n"
    # What is unchanged keeps its time, so that nothing has to be collected again.
    if not path.is_file() or path.read_text(encoding="utf-8") != text:
        write_whole(path, text)


def write_whole(path, text):
    """Writes a file such that nobody ever sees a part of it."""
    partial = path.with_name(f".{path.name}.{os.getpid()}")
    partial.write_text(text, encoding="utf-8")
    partial.replace(path)


def _cases_of_folder(folder):
    files = sorted(p for p in folder.iterdir() if p.suffix.lower() in SURFACE_SUFFIXES)
    stems = [file.stem for file in files]
    # Two files of one stem are told apart by their extensions.
    names = [file.stem if stems.count(file.stem) == 1 else file.name for file in files]
    return [
        Case(re.sub(r"[^A-Za-z0-9_.-]", "_", name), str(file.absolute()), "", {})
        for name, file in zip(names, files)
    ]


def _cases_of_table(path):
    with open(path, encoding="utf-8-sig", newline="") as file:
        rows = list(csv.DictReader(file, delimiter="\t"))
        if rows and "surface" not in rows[0]:
            raise CohortError(f"{path} has no column 'surface' (tabs between columns?)")
    cases = []
    problems = []
    seen = {}
    for line, row in enumerate(rows, start=2):
        surface = (row.pop("surface") or "").strip()
        name = (row.pop("case", None) or Path(surface).stem).strip()
        options = (row.pop("options", None) or "").strip()
        if None in row:
            problems.append(f"line {line} has more columns than the header")
        elif not surface:
            problems.append(f"line {line} has no surface")
        elif not CASE_NAME.fullmatch(name):
            problems.append(f"line {line}: '{name}' is no name for a case: letters, digits, _ . -")
        elif name in seen:
            problems.append(f"lines {seen[name]} and {line} are both called '{name}'")
        seen.setdefault(name, line)
        row.pop(None, None)
        cases.append(Case(name, str((path.parent / surface).absolute()), options, row))
    if problems:
        raise CohortError("\n".join([f"{path} cannot be used:", *problems]))
    return cases
