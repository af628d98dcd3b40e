#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reports of a small run and of a small study in a real browser: all that they name is there, nothing is wider than the
page, on a telephone either, and there is something to see. PROGRAM CHROMIUM FOLDER: pictures of them are left in FOLDER.
"""
import html
import json
import pathlib
import re
import struct
import subprocess
import sys
import tempfile

WORKFLOW = """
name: small
packing: {type: regular, lattice: sc, radius: 1 mm, container: {shape: box, size: [8 mm, 8 mm, 16 mm]}}
material: {density: 2650 kg/m3}
bonding: {tolerance: 0.15}
contact_law: {type: elastic_brittle, bond_modulus: 10 GPa, stiffness_ratio: 3.7, tensile_strength: 40 MPa, shear_strength: 40 MPa, friction: 0.5}
damping: {translational: 0.7, rotational: 0.7}
protocol: {type: uniaxial_compression, platen_velocity: 0.2 m/s, platen_stiffness: 15 MN/m, max_strain: 0.4 %}
sampling: {every_steps: 5}
postprocessors: [{type: stress}, {type: bagi_strain}, {type: elastic_constants}, {type: damage}, {type: energy}]
outputs: [{type: vtk, interval: 1 s}]
renderers: [{type: pictures, size: 300}]
reference: {source: "A. Name (2020), A Journal With a Long Name in Many Words and no End 12, 345-678", peak_stress_Pa: 4.0e+7}
"""
STUDY = """
name: two_values
workflow: small.yaml
fixed: {outputs: [], renderers: []}
grid: {contact_law.tensile_strength: [20 MPa, 40 MPa], contact_law.friction: [0.3, 0.5]}
charts: [{x: contact_law.tensile_strength, y: peak_stress_Pa, series: contact_law.friction}]
"""
# The reports stand in frames as wide as a telephone and as a screen; what each of them says is gathered here.
PROBE = """<!DOCTYPE html><meta charset="utf-8">
%(frames)s
<script>
function look(frame) {
  const page = frame.contentDocument, root = page.documentElement, wide = [];
  for (const e of page.querySelectorAll("body *")) {
    const box = e.getBoundingClientRect();
    if (box.right > root.clientWidth + 1 && !e.closest(".scroll, pre, svg")) wide.push(e.tagName + " " + e.className + " " + box.right);
  }
  return {
    source: frame.dataset.name, width: root.clientWidth, scroll: root.scrollWidth, wide: wide, height: root.scrollHeight,
    images: [...page.images].map(i => i.complete && i.naturalWidth > 0),
    unnamed: [...page.images].filter(i => !i.alt).length + [...page.querySelectorAll("figure > svg")].filter(s => !s.querySelector("title")).length,
    charts: [...page.querySelectorAll("figure > svg")].map(s => s.getBoundingClientRect().height),
    repeated: [...page.querySelectorAll("[id]")].length - new Set([...page.querySelectorAll("[id]")].map(e => e.id)).size,
    lost: [...page.querySelectorAll("a[href^='#']")].filter(a => !page.getElementById(a.getAttribute("href").slice(1))).length,
    outside: [...page.querySelectorAll("[src], [href]")].map(e => e.getAttribute("src") || e.getAttribute("href")).filter(u => !/^(data:image|#)/.test(u)),
    scripts: page.scripts.length, title: page.title, heading: page.querySelectorAll("h1").length
  };
}
onload = () => { document.body.innerHTML = "<pre id=found>" + JSON.stringify([...document.querySelectorAll("iframe")].map(look)).replace(/</g, "") + "</pre>"; };
</script>
"""


def fail(text):
    sys.exit(f"report in a browser: {text}")


class Browser:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder

    def __call__(self, page, *options):
        profile = tempfile.mkdtemp(dir=self.folder)
        # Without sandbox: the kernel of a container lets nobody but root make one. Only files of this test are opened.
        run = subprocess.run([self.program, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--no-first-run",
                              "--disable-dev-shm-usage", "--allow-file-access-from-files", "--virtual-time-budget=10000",
                              "--enable-logging=stderr", f"--user-data-dir={profile}", *options, page.as_uri()],
                             capture_output=True, text=True, timeout=120)
        if run.returncode != 0:
            fail(f"{self.program} ended with {run.returncode}: {run.stderr[-2000:]}")
        said = [line for line in run.stderr.splitlines() if "CONSOLE" in line]
        if said:
            fail(f"{page.name}: the browser complains: {said[0]}")
        return run.stdout


def size_of(png):
    head = png.read_bytes()[:24]
    if head[:8] != b"\x89PNG\r\n\x1a\n":
        fail(f"{png.name} is no picture")
    return struct.unpack(">II", head[16:24])


def main():
    program, chromium, pictures = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    pictures.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        browser = Browser(chromium, folder)
        (folder / "small.yaml").write_text(WORKFLOW)
        (folder / "study.yaml").write_text(STUDY)
        environment = {"PATH": "/usr/bin:/bin", "BRECCIA_CACHE": str(folder / "cache"), "HOME": name}
        for arguments in ("run small.yaml --output run", "sweep study.yaml -o study", "report run --author 'A. Name'", "report study"):
            done = subprocess.run(f"'{program}' {arguments}", shell=True, cwd=folder, env=environment, capture_output=True, text=True)
            if done.returncode != 0:
                fail(f"breccia {arguments}: {done.stdout}{done.stderr}")
        frames = ""
        for report in ("run", "study"):
            for width in (360, 1280):
                frames += f'<iframe data-name="{report}" src="{report}/report.html" style="width:{width}px;height:800px;border:0"></iframe>\n'
        (folder / "probe.html").write_text(PROBE % {"frames": frames})
        dom = browser(folder / "probe.html", "--dump-dom")
        found = re.search(r'<pre id="found">(.*?)</pre>', dom, flags=re.S)
        if not found:
            fail("the probe has said nothing")
        for page in json.loads(html.unescape(found[1])):
            where = f"{page['source']} at {page['width']} px"
            if page["width"] not in (360, 1280):
                fail(f"{where}: the frame has another width")
            if page["scroll"] > page["width"] or page["wide"]:
                fail(f"{where}: wider than the page: {page['scroll']} px, {page['wide'][:3]}")
            if not all(page["images"]) or page["unnamed"]:
                fail(f"{where}: a picture is missing or has no name: {page['images']}")
            if not page["charts"] or min(page["charts"]) < 100:
                fail(f"{where}: no chart, or one too small to read: {page['charts']}")
            if page["source"] == "run" and len(page["images"]) < 2:
                fail(f"{where}: the run's pictures are not in it")
            if page["repeated"] or page["lost"] or page["outside"] or page["scripts"]:
                fail(f"{where}: ids that repeat, links that lead nowhere or outside, scripts: {page}")
            if page["heading"] != 1 or not page["title"] or page["height"] < 1000:
                fail(f"{where}: this is no whole page: {page}")
        for report in ("run", "study"):
            file = pictures / f"{report}.png"
            file.unlink(missing_ok=True)
            browser(folder / report / "report.html", "--window-size=1000,2400", f"--screenshot={file}")
            if size_of(file) != (1000, 2400) or file.stat().st_size < 40000:
                fail(f"the picture of {report} shows nothing: {size_of(file)}, {file.stat().st_size} bytes")
        paper = pictures / "run.pdf"
        browser(folder / "run" / "report.html", "--no-pdf-header-footer", f"--print-to-pdf={paper}")
        if not paper.read_bytes().startswith(b"%PDF"):
            fail("nothing was printed")
    print("reports stand in a browser as they should")


if __name__ == "__main__":
    main()
