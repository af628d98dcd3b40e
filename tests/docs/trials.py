# SPDX-License-Identifier: BSD-3-Clause
"""How a code block of each language is tried. A trial returns what is wrong with the block, an empty text if nothing is."""
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

root = pathlib.Path(__file__).resolve().parent.parent.parent
files = pathlib.Path(__file__).resolve().parent / "files"

# Programs other than ours whose commands are read for their syntax alone.
OTHERS = {"cmake", "ctest", "git", "pre-commit", "sbatch", "snakemake", "export", "cd", "cp", "mkdir", "perf", "yes", "apt", "sudo"}


class Skip(Exception):
    """A block that cannot be tried here, with the reason."""


class Trials:
    def __init__(self, program, build, scratch):
        self.program, self.build, self.scratch = program, build, scratch
        self.counts, self.help = {}, {}
        keys = {what: {p["name"] for p in json.loads(self.says("describe", what, "--format", "json"))["parameters"]}
                for what in ("workflow", "sweep", "calibration")}
        self.workflow_keys = keys["workflow"]
        self.study_keys = (keys["sweep"] | keys["calibration"]) - keys["workflow"]

    def says(self, *arguments):
        return subprocess.run([self.program, *arguments], capture_output=True, text=True, check=True).stdout

    def count(self, what):
        self.counts[what] = self.counts.get(what, 0) + 1

    def folder(self, page):
        """The folder of a page: as one who reads it would have it, with the tree's workflows and some small files."""
        folder = self.scratch / re.sub(r"\W", "_", page)
        if not folder.exists():
            (folder / "build/bin").mkdir(parents=True)
            (folder / "build/bin/breccia").symlink_to(self.program)
            for name in ("workflows", "docs", "tools", "tests"):
                (folder / name).symlink_to(root / name)
            for file in files.iterdir():
                shutil.copy(file, folder)
        return folder

    def environment(self):
        return os.environ | {"PATH": f"{self.program.parent}:{os.environ['PATH']}", "OMP_NUM_THREADS": "2", "LC_ALL": "C.UTF-8",
                             "CMAKE_PREFIX_PATH": str(self.build), "PYTHONPATH": str(root / "python"), "PYTHONDONTWRITEBYTECODE": "1"}

    def call(self, command, folder, seconds=300):
        done = subprocess.run(command, cwd=folder, env=self.environment(), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, timeout=seconds)
        return done.returncode, done.stdout

    def trial(self, block):
        if block.marker.startswith("not run: "):
            raise Skip(block.marker.removeprefix("not run: "))
        known = {"yaml": self.yaml, "sh": self.sh, "console": self.console, "cpp": self.cpp, "cmake": self.kept, "python": self.python,
                 "csv": self.kept, "text": self.text}
        if block.language not in known:
            return f"`{block.language}` is no language that is tried here: {', '.join(sorted(known))}"
        for word in block.marker.split("; "):
            if word.startswith("same as "):
                path = word.removeprefix("same as ")
                self.count("the same as a file of the tree")
                if (root / path).read_text(encoding="utf-8") != block.text:
                    return f"differs from {path}"
            elif word.startswith("file "):
                file = self.folder(block.page) / word.removeprefix("file ")
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(block.text, encoding="utf-8")
            elif word.startswith("after "):
                code, said = self.call(["bash", "-c", word.removeprefix("after ")], self.folder(block.page))
                if code:
                    return said.strip()
            elif word and word != "run" and not word.startswith("over "):
                return f"`{word}` is no marker that is known"
        return known[block.language](block)

    def text(self, block):
        self.count("text")
        return ""

    def kept(self, block):
        """Of no use by itself."""
        self.count("files for what follows")
        return "" if block.marker else "is compared with nothing: say `same as PATH` or `file NAME`"

    # Workflows and studies

    def yaml(self, block):
        keys = set(re.findall(r"^(\w+):", block.text, flags=re.M))
        folder = self.folder(block.page)
        file = folder / f"block_{block.line}.yaml"
        text = self.filled(block.text)
        if keys & self.study_keys:
            self.count("studies")
            if not keys & {"workflow", "workflows"}:
                text = "workflow: base.yaml\n" + text
        elif not keys or keys - self.workflow_keys:
            return f"no workflow has the sections {', '.join(sorted(keys - self.workflow_keys))}"
        elif "base" in keys or keys >= {"packing", "protocol", "contact_law"}:
            self.count("workflows")
        else:
            self.count("parts of workflows")
            over = next((w.removeprefix("over ") for w in block.marker.split("; ") if w.startswith("over ")), "base.yaml")
            text = f"base: {over}\n" + text
        file.write_text(text, encoding="utf-8")
        code, said = self.call([self.program, "validate", file.name], folder)
        return "" if code == 0 else said.strip()

    def filled(self, text):
        """`...` in a plugin's section stands for what it cannot do without: the examples of its declarations."""
        def fill(match):
            section, name = match[0], match[1]
            rest = [f"{key}: {value}" for key, value in self.needed(name).items() if not re.search(rf"\b{key}:", section)]
            flow = re.search(r",\s*\.\.\.\s*}", section)
            if flow:
                return section.replace(flow[0], "".join(", " + r for r in rest) + "}")
            indent, end = re.search(r"^([ ]+)\.\.\.[ ]*\n", section, flags=re.M)[1], re.compile(r"^[ ]+\.\.\.[ ]*\n", re.M)
            return end.sub("".join(f"{indent}{r}\n" for r in rest).replace("\\", r"\\"), section)
        text = re.sub(r"\{type: (\w+)(?:[^{}]|\{[^{}]*\})*?,\s*\.\.\.\s*\}", fill, text)
        return re.sub(r"^[ ]+type: (\w+)\n(?:[ ]+.*\n)*?[ ]+\.\.\.[ ]*\n", fill, text, flags=re.M)

    def needed(self, name):
        described = json.loads(self.says("describe", name, "--format", "json"))
        one_of = {group[0] for group in described.get("exactly_one_of", [])}
        return {p["name"]: p["example"] for p in described["parameters"] if "example" in p and (p["required"] or p["name"] in one_of)}

    # Commands

    def sh(self, block):
        folder = self.folder(block.page)
        if block.marker == "run":
            self.count("blocks of commands that are run")
            code, said = self.call(["bash", "-euo", "pipefail", "-c", block.text], folder)
            return "" if code == 0 else f"exit code {code}\n{said.strip()}"
        code, said = self.call(["bash", "-n", "-c", block.text], folder)
        if code:
            return said.strip()
        wrong = [self.command(line, folder) for line in block.text.replace("\\\n", " ").splitlines() if line.split("#")[0].strip()]
        return "\n".join(w for w in wrong if w)

    def command(self, line, folder):
        words = shlex.split(line, comments=True)
        while words and (found := re.match(r"^\w+=(?:\$\()?(.*)$", words[0])):  # VARIABLE=..., n=$(...
            words[0:1] = [found[1]] if "$(" in words[0] else []
        if not words:
            return ""
        self.count("commands")
        if words[0] in ("breccia", "build/bin/breccia"):
            end = next((k for k, w in enumerate(words) if w in ("|", "&&", ";", ">")), len(words))
            return self.own(words[1:end], folder)
        if words[0].startswith(("tools/", "tests/", ".ci/")):
            if not (root / words[0]).is_file():
                return f"{words[0]}: is not there"
            text = (root / words[0]).read_text()
            return "\n".join(f"{words[0]}: knows no {w}" for w in words[1:] if w.startswith("--") and w.split("=")[0] not in text)
        return "" if words[0] in OTHERS else f"{words[0]}: is no program that is known here"

    def own(self, words, folder):
        """A command of the program: its options must be known; what it would read must be in order; what is quick is run."""
        verb = words[0]
        if verb not in self.help:
            code, said = self.call([self.program, verb, "--help"], folder)
            self.help[verb] = said if code == 0 else ""
        if not self.help[verb]:
            return f"breccia {verb}: there is no such verb"
        known = set(re.findall(r"(?<![\w-])--?[a-z][\w-]*", self.help[verb]))
        unknown = [w for w in words[1:] if re.match(r"--?[a-z]", w) and w.split("=")[0] not in known]
        if unknown:
            return f"breccia {verb}: knows no {', '.join(unknown)}"
        readable = [w for w in words[1:] if w.endswith(".yaml") and (folder / w).exists()]
        if verb in ("run", "validate", "sweep", "calibrate") and readable:
            settings = [w for k, word in enumerate(words[:-1]) if word in ("--set", "--variant") for w in (word, words[k + 1])]
            code, said = self.call([self.program, "validate", *readable, *settings], folder)
        elif verb in ("describe", "list", "drive", "schema") or (verb == "check" and "--plugin" not in words):
            if any(w.isupper() for w in words):
                return ""
            code, said = self.call([self.program, *words], folder)
        else:
            return ""
        return "" if code == 0 else f"breccia {' '.join(words)}: {said.strip()}"

    def console(self, block):
        """`$ command` and what it says, to the letter."""
        self.count("answers of the program")
        folder, wrong = self.folder(block.page), []
        for command, expected in re.findall(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", block.text, flags=re.M):
            said = self.call(["bash", "-c", command], folder)[1]
            if said.strip() != expected.strip():
                wrong.append(f"{command}\nsays\n{said.strip()}\nrather than\n{expected.strip()}")
        return "\n".join(wrong)

    # Programs

    def cpp(self, block):
        if block.marker:
            return self.kept(block)
        self.count("compiled")
        file = self.folder(block.page) / f"block_{block.line}.cpp"
        file.write_text('#include "breccia/contact_law.hpp"\nusing namespace breccia;\n' + block.text)
        code, said = self.call(["g++", "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "-fno-math-errno", "-fopenmp-simd",
                                '-DBRECCIA_PLUGIN_VERSION="0"', f"-I{root}/core/sdk", f"-I{self.build}/sdk", "-isystem/usr/include/eigen3", file.name],
                               file.parent)
        return "" if code == 0 else said.strip()

    def python(self, block):
        modules = set(re.findall(r"^\s*(?:import|from) (\w+)", block.text, flags=re.M))
        for python in (sys.executable, "/usr/bin/python3"):
            found = subprocess.run([python, "-c", "import " + ", ".join(sorted(modules) or ["sys"])], env=self.environment(), capture_output=True)
            if found.returncode == 0:
                self.count("Python")
                code, said = self.call([python, "-W", "error::SyntaxWarning", "-c", block.text], self.folder(block.page))
                return "" if code == 0 else said.strip()
        raise Skip("no Python here has " + ", ".join(sorted(modules)))
