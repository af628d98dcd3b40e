#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The test of the test: in a small tree each kind of fault is found at its place, and without them none is."""
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
from include_graph import Tree  # noqa: E402

GOOD = {
    "ARCHITECTURE.md": "# A\n\n```text\n# arrows: room -> rooms that it may use : what it is for\nsdk -> : contracts\n"
                       "engine -> sdk : steps\nrun -> sdk engine : one run\n           which goes on here\n```\n",
    "core/sdk/breccia/law.hpp": "#include <vector>\n",
    "core/engine/step.hpp": '#include "breccia/law.hpp"\n',
    "core/engine/CMakeLists.txt": "target_link_libraries(breccia_engine PUBLIC Breccia::sdk)\n",
    "core/run/runner.hpp": '#include <breccia/law.hpp>\n#include "engine/step.hpp"\n',
    "plugins/output/vtk/vtk.cpp": '#include <vtkNew.h>\n#include "breccia/law.hpp"\n#include "own.hpp"\n#include "../../shared/all.hpp"\n',
    "plugins/output/vtk/own.hpp": "",
    "plugins/output/csv/csv.hpp": "",
    "plugins/shared/all.hpp": "",
}
# What is put in place of a file's text, and the one line that must be said of it.
FAULTS = [
    ("core/engine/step.hpp", '\n#include "breccia/law.hpp"\n#include "run/runner.hpp"\n', "core/engine/step.hpp:3: ", "engine -> run"),
    ("core/engine/step.hpp", '#include "breccia/law.hpp"\n#include "../run/runner.hpp"\n', "core/engine/step.hpp:2: ", "engine -> run"),
    ("core/engine/step.hpp", '#include "breccia/law.hpp"\n#  include <run/runner.hpp>\n', "core/engine/step.hpp:2: ", "engine -> run"),
    ("core/sdk/breccia/law.hpp", '#include "engine/step.hpp"\n', "core/sdk/breccia/law.hpp:1: ", "sdk -> engine"),
    ("core/engine/CMakeLists.txt", "\ntarget_link_libraries(breccia_engine PUBLIC breccia_run)\n", "core/engine/CMakeLists.txt:2: ", "breccia_run"),
    ("core/run/runner.hpp", '#include "breccia/law.hpp"\n', "ARCHITECTURE.md:7: ", "core/engine: the arrow is not needed"),
    ("plugins/output/vtk/vtk.cpp", '#include "engine/step.hpp"\n', "plugins/output/vtk/vtk.cpp:1: ", "not engine/step.hpp"),
    ("plugins/output/vtk/vtk.cpp", "#include <engine/step.hpp>\n", "plugins/output/vtk/vtk.cpp:1: ", "not engine/step.hpp"),
    ("plugins/output/vtk/vtk.cpp", '\n#include "../csv/csv.hpp"\n', "plugins/output/vtk/vtk.cpp:2: ", "not ../csv/csv.hpp"),
    ("plugins/output/vtk/vtk.cpp", '#include "../../../core/engine/step.hpp"\n', "plugins/output/vtk/vtk.cpp:1: ", "not ../../../core"),
    ("core/extra/new.hpp", "", "ARCHITECTURE.md:4: ", "core/extra is not in the drawing"),
    ("ARCHITECTURE.md", GOOD["ARCHITECTURE.md"].replace("engine -> sdk", "engine -> sdk run"), "ARCHITECTURE.md:6: ", "run does not stand above"),
    ("ARCHITECTURE.md", GOOD["ARCHITECTURE.md"].replace(" : steps", ""), "ARCHITECTURE.md:6: ", "not `room -> rooms"),
    ("ARCHITECTURE.md", GOOD["ARCHITECTURE.md"].replace("run -> sdk engine", "walk -> sdk engine"), "ARCHITECTURE.md:7: ", "there is no core/walk"),
]


def said_of(changed):
    """What is said of the small tree with these files in it."""
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder).resolve()
        for name, text in {**GOOD, **changed}.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text, encoding="utf-8")
        return Tree(root).check()


missed = [f"the good tree: {line}" for line in said_of({})]
for file, text, place, why in FAULTS:
    said = said_of({file: text})
    if not any(line.startswith(place) and why in line for line in said):
        missed.append(f"{file} with {text!r}: expected {place}...{why}, was told {said}")
print("\n".join(missed) if missed else f"{len(FAULTS)} faults, each found at its place")
sys.exit(1 if missed else 0)
