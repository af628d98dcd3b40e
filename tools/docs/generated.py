# SPDX-License-Identifier: BSD-3-Clause
"""Pages that are made of what the program says of itself: one a plugin, lists of plugins, the keys of files."""
import json
import pathlib
import re
import subprocess

from docs import pages


class Program:
    def __init__(self, path):
        self.path = pathlib.Path(path)

    def says(self, *arguments):
        done = subprocess.run([self.path, *arguments], capture_output=True, text=True)
        if done.returncode:
            raise SystemExit(f"site: breccia {' '.join(arguments)}: {done.stderr.strip()}")
        return done.stdout

    def kinds(self):
        """Kinds in the order of the program, with the names and summaries of their plugins."""
        kinds = list(dict.fromkeys(line.split("/")[0] for line in self.says("list").splitlines() if "/" in line.split()[0]))
        return {kind: json.loads(self.says("describe", kind, "--format", "json"))["plugins"] for kind in kinds}

    def keys(self, what):
        """`describe` without its heading."""
        return re.sub(r"\A###.*\n+", "", self.says("describe", what, "--format", "markdown"))


def readme_of(kind, name):
    """The README of a plugin's folder, without its heading."""
    file = pages.root / "plugins" / kind / name / "README.md"
    return re.sub(r"\A# .*\n+", "", file.read_text(encoding="utf-8")) if file.is_file() else ""


def write_plugins(stage, program):
    """Returns the menu's entries."""
    menu, overview = [], "# Plugins\n\nMade of `breccia describe`. Each page ends with the plugin's parameters.\n"
    for kind, plugins in program.kinds().items():
        entries = []
        overview += f"\n## {kind}\n\n| plugin | what it does |\n|---|---|\n"
        for plugin in plugins:
            name, page = plugin["name"], f"plugins/{kind}/{plugin['name']}.md"
            source = f"plugins/{kind}/{name}/README.md"
            head, _, table = program.keys(f"{kind}/{name}").partition("\n| parameter |")
            parameters = "| parameter |" + table if table else "None.\n"
            said = [part for part in head.strip().split("\n\n") if part != "No parameters."]
            if readme := readme_of(kind, name):
                del said[1:-1]  # the details, which the README has at length
            text = f"# {name}\n\n*{kind}* · " + "\n\n".join(said) + "\n\n"
            text += stage.linked(source, page, readme) + f"\n## Parameters\n\n{parameters}"
            stage.write(page, text)
            overview += f"| [{name}]({kind}/{name}.md) | {plugin['summary']} |\n"
            entries.append({name: page})
        menu.append({kind: entries})
    stage.write("plugins/index.md", overview)
    return [{"Overview": "plugins/index.md"}, *menu]


def write_keys(stage, program):
    workflow = ("# Keys of a workflow\n\nMade of `breccia describe workflow`; [workflow.schema.json](../workflow.schema.json) says the same to "
                "an editor. Sections of plugins: [Plugins](../plugins/index.md).\n\n")
    study = "# Keys of a study\n\nMade of `breccia describe sweep`; how a study is written: [Parameter studies](../sweeps.md).\n\n"
    calibration = ("# Keys of a calibration\n\nMade of `breccia describe calibration`; how one is written: "
                   "[Calibration](../calibration.md).\n\n")
    wide = "---\nhide: [toc]\n---\n"  # these pages are one table
    stage.write("reference/workflow.md", wide + workflow + program.keys("workflow"))
    stage.write("reference/sweep.md", wide + study + program.keys("sweep"))
    stage.write("reference/calibration.md", wide + calibration + program.keys("calibration"))
    for schema in ("workflow", "sweep", "calibration"):
        stage.copy(f"docs/{schema}.schema.json", f"{schema}.schema.json")


def write_validation(stage):
    """The list of the reports; returns the menu's entries."""
    text, menu = "# Validation\n\nWhat was measured against the papers, and where the differences come from.\n\n", []
    for report in sorted((pages.root / "docs/validation").glob("*.md")):
        heading = pages.title(report.read_text(encoding="utf-8"))
        text += f"- [{heading}]({report.name})\n"
        menu.append({heading.split(":")[0]: f"validation/{report.name}"})
    stage.write("validation/index.md", text)
    return [{"Overview": "validation/index.md"}, *menu]
