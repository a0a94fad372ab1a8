#!/usr/bin/env python3
"""Makes the pictures of the book that are of a browser: docs/report.png, docs/rerun.png and docs/notebook.png.

    pip install 'eyebolt[rerun]' pillow websocket-client nbconvert
    docs/screenshots.py [docs]

Needs Chromium (CHROMIUM names it). Pictures are of few colours, so that they stay small.
"""

import atexit
import base64
import contextlib
import io
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import urllib.parse
import urllib.request
from pathlib import Path

import websocket
from PIL import Image

import eyebolt

HERE = Path(__file__).resolve().parent
NAMES = ("chromium", "chromium-browser", "google-chrome")
# Without a graphics card.
SOFTWARE = ("--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist")
COLORS = 96


def free_port():
    with socket.socket() as listening:
        listening.bind(("127.0.0.1", 0))
        return listening.getsockname()[1]


def answered(url, tries=240):
    """What `url` answers, once something does."""
    for _ in range(tries):
        with contextlib.suppress(OSError):
            return urllib.request.urlopen(url).read()
        time.sleep(0.25)
    sys.exit(f"{url} does not answer")


def started(command):
    """A process with a group of its own: `python -m rerun` and Chromium start others."""
    return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)


def ended(process):
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


class Page:
    """A page in Chromium, driven by its debugging protocol."""

    def __init__(self, url, width, height, profile):
        browser = os.environ.get("CHROMIUM") or next(filter(None, map(shutil.which, NAMES)), None)
        if browser is None:
            sys.exit("there is no Chromium: install it, or name it by CHROMIUM")
        port = free_port()
        options = ["--headless=new", "--no-sandbox", f"--user-data-dir={profile}", f"--window-size={width},{height}"]
        debugging = [f"--remote-debugging-port={port}", "--remote-allow-origins=*"]
        command = [browser, *options, *SOFTWARE, *debugging, url]
        self.process = started(command)
        atexit.register(ended, self.process)
        pages = json.loads(answered(f"http://127.0.0.1:{port}/json"))
        address = next(page["webSocketDebuggerUrl"] for page in pages if page["type"] == "page")
        self.socket = websocket.create_connection(address, timeout=120)
        self.asked = 0
        view = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
        self.ask("Emulation.setDeviceMetricsOverride", **view)

    def ask(self, method, **parameters):
        self.asked += 1
        self.socket.send(json.dumps({"id": self.asked, "method": method, "params": parameters}))
        while True:
            told = json.loads(self.socket.recv())
            if told.get("id") == self.asked:
                return told["result"]

    def picture(self):
        data = self.ask("Page.captureScreenshot", format="png")["data"]
        return Image.open(io.BytesIO(base64.b64decode(data))).convert("RGB")

    def settled(self, least_s, most_s=90):
        """The picture, once it stays as it is and is not empty."""
        begun, before = time.monotonic(), None
        while True:
            time.sleep(1.5)
            now = self.picture()
            passed = time.monotonic() - begun
            still = before is not None and now.tobytes() == before.tobytes()
            if still and passed > least_s and len(now.resize((64, 64)).getcolors(4096)) > 8:
                return now
            if passed > most_s:
                sys.exit(f"the page still changes, or is empty, after {most_s} s")
            before = now

def capture(url, output, size, least_s, folder):
    page = Page(url, *size, tempfile.mkdtemp(dir=folder))
    try:
        picture = page.settled(least_s)
    finally:
        ended(page.process)
    picture.quantize(COLORS, dither=Image.Dither.NONE).save(output, optimize=True)
    print(f"{output}: {output.stat().st_size // 1000} kB")


def rerun(path, output, folder):
    """Rerun's viewer for browsers, with this recording."""
    web, data = free_port(), free_port()
    command = [sys.executable, "-m", "rerun", "--serve-web", "--bind", "127.0.0.1", "--web-viewer-port", str(web), "--port", str(data), path]
    server = started(command)
    try:
        answered(f"http://127.0.0.1:{web}/")
        source = urllib.parse.quote(f"rerun+http://127.0.0.1:{data}/proxy", safe="")
        url = f"http://127.0.0.1:{web}/?url={source}&renderer=webgl&hide_welcome_screen=true&theme=light"
        capture(url, output, (1400, 720), 30, folder)
    finally:
        ended(server)


def main():
    output = Path(sys.argv[1] if len(sys.argv) > 1 else HERE).resolve()
    # Chromium may still write when it is killed.
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        folder = Path(folder)
        # The report names its recording.
        os.chdir(folder)
        eyebolt.simulate("session.mcap", seed=7)
        calibration = eyebolt.calibrate("session.mcap")
        calibration.report(folder / "report.html")
        capture((folder / "report.html").as_uri(), output / "report.png", (1100, 1000), 3, folder)
        calibration.rerun(folder / "calibration.rrd")
        rerun(folder / "calibration.rrd", output / "rerun.png", folder)
        notebook = HERE.parent / "python/examples/calibrate.ipynb"
        convert = [sys.executable, "-m", "jupyter", "nbconvert", "--to", "html", "--output-dir", folder, notebook]
        subprocess.run(convert, check=True, stderr=subprocess.DEVNULL)
        capture((folder / "calibrate.html").as_uri(), output / "notebook.png", (1000, 1000), 3, folder)


if __name__ == "__main__":
    main()
