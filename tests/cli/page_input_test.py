"""Uses the pages of `burnish view` as a person does: mouse, wheel, fingers and keys reach Chromium as input events, and what is seen of
the page afterwards, pixel by pixel, must be what they ask for. Ends with 77 where there is no Chromium.

Usage: page_input_test.py BURNISH CHROMIUM
"""

import base64
import fcntl
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parents[1]))
from png_picture import Picture  # noqa: E402

PLANE = """
title: Slab
geometry: {shape: rectangle, size: [2, 1], spans: [4, 2]}
material: {law: neo-hookean, E: 1, nu: 0.3}
supports: [{face: bottom, fix: [x, y]}, {face: top, move: {times: [0, 1], x: [0, 0.3], y: [0, -0.1]}}]
steps: [{until: 1, count: 1}]
"""
SPACE = """
title: Block
geometry: {shape: box, size: [2, 1, 1], spans: [2, 1, 1]}
material: {law: neo-hookean, E: 1, nu: 0.3}
supports: [{face: bottom, fix: [x, y, z]}, {face: top, move: {times: [0, 1], x: [0, 0.3], y: [0, 0], z: [0, 0]}}]
steps: [{until: 1, count: 1}]
"""

CONTACT = """
title: Ball on a block
geometry: {shape: box, size: [2, 1, 2], spans: [6, 2, 6]}
material: {law: neo-hookean, E: 1, nu: 0.3}
supports: [{face: bottom, fix: [x, y, z]}]
tools: [{name: ball, shape: sphere, center: [1, 1.5, 1], radius: 0.5, motion: {times: [0, 1], y: [0, -0.15]}}]
contact: [{tool: ball, face: top}]
steps: [{until: 1, count: 3}]
"""


class Browser:
    """Chromium, by its DevTools protocol through pipes."""

    def __init__(self, program, profile):
        to_read, self.to = os.pipe()
        self.source, from_write = os.pipe()

        def place_pipes():
            for end, wanted in [(fcntl.fcntl(end, fcntl.F_DUPFD, 10), wanted) for end, wanted in ((to_read, 3), (from_write, 4))]:
                os.dup2(end, wanted)

        self.process = subprocess.Popen(
            [program, "--headless", "--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader", "--remote-debugging-pipe",
             f"--user-data-dir={profile}", "--window-size=800,600"],
            close_fds=False, preexec_fn=place_pipes, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_read)
        os.close(from_write)
        self.number, self.buffer, self.session, self.messages = 0, b"", None, []
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        self.call("Runtime.enable")
        self.call("Emulation.setDeviceMetricsOverride", width=760, height=520, deviceScaleFactor=1, mobile=False)

    def close(self):
        self.process.kill()
        self.process.wait()

    def call(self, method, **parameters):
        self.number += 1
        request = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            request["sessionId"] = self.session
        os.write(self.to, json.dumps(request).encode() + b"\0")
        while True:
            answer = self._next()
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]
            if answer.get("method") in ("Runtime.exceptionThrown", "Runtime.consoleAPICalled"):
                self.messages.append(json.dumps(answer["params"])[:300])

    def _next(self):
        while b"\0" not in self.buffer:
            more = os.read(self.source, 1 << 16)
            if not more:
                raise RuntimeError("the browser has ended")
            self.buffer += more
        message, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(message)

    def value(self, script):
        answer = self.call("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(json.dumps(answer["exceptionDetails"])[:500])
        return answer["result"].get("value")

    def open(self, page):
        self.call("Page.navigate", url=page.resolve().as_uri())
        while not self.value("document.readyState === 'complete' && typeof state === 'object'"):
            pass
        x, y, width, height = self.value("(({x, y, width, height}) => [x, y, width, height])(canvas.getBoundingClientRect())")
        rim = 4  # which tells where keys go
        self.canvas = {"x": math.ceil(x) + rim, "y": math.ceil(y) + rim, "width": math.floor(width) - 2 * rim - 1,
                       "height": math.floor(height) - 2 * rim - 1}
        self.middle = (x + width / 2, y + height / 2)

    def settle(self):
        self.value("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(0))))")

    def picture(self):
        self.settle()
        shot = self.call("Page.captureScreenshot", format="png", clip={**self.canvas, "scale": 1})
        return Picture(base64.b64decode(shot["data"]))

    def state(self, key):
        return self.value(f"state.{key}")

    def mouse(self, kind, x, y, **more):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def drag(self, right, down, **more):
        x, y = self.middle
        self.mouse("mousePressed", x, y, button="left", buttons=1, clickCount=1, **more)
        for part in (0.5, 1.0):
            self.mouse("mouseMoved", x + part * right, y + part * down, button="left", buttons=1, **more)
        self.mouse("mouseReleased", x + right, y + down, button="left", buttons=0, clickCount=1, **more)

    def key(self, name, code=None, text=None):
        letters = {"text": text} if text else {}
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=name, code=code or name, **letters)

    def touch(self, kind, places):
        self.call("Input.dispatchTouchEvent", type=kind,
                  touchPoints=[{"x": x, "y": y, "id": number} for number, (x, y) in enumerate(places)])

    def pinch(self, before, after):
        x, y = self.middle
        both = lambda apart: [(x - apart / 2, y), (x + apart / 2, y)]
        self.touch("touchStart", both(before))
        for part in (0.5, 1.0):
            self.touch("touchMove", both(before + part * (after - before)))
        self.touch("touchEnd", [])


class Facts:
    def __init__(self):
        self.wrong = 0

    def near(self, what, found, wanted, slack):
        if not abs(found - wanted) <= slack:
            self.wrong += 1
            print(f"WRONG {what}: found {found}, expected {wanted} within {slack}")

    def holds(self, what, truth):
        self.near(what, 1 if truth else 0, 1, 0)


def check_plane(browser, facts):
    """A body in the plane is moved and zoomed; the picture is the first one, moved or larger."""
    first = browser.picture()
    left, top, right, bottom = first.body()
    facts.holds("a body is seen", right - left > 100 and bottom - top > 50)

    browser.drag(30, -20)
    facts.near("dragged picture", browser.picture().differs(first, 30, -20), 0.0, 0.002)
    facts.holds("a drag is seen", browser.picture().differs(first) > 0.02)
    browser.key("ArrowLeft")  # the eye goes there
    browser.key("ArrowUp")
    facts.near("picture after keys", browser.picture().differs(first, 30 + 40, -20 + 40), 0.0, 0.002)
    browser.key("0", "Digit0", "0")
    facts.near("picture after 0", browser.picture().differs(first), 0.0, 0.0)

    x, y = browser.middle
    browser.mouse("mouseWheel", x, y, deltaX=0, deltaY=200)
    wide = browser.picture().body()
    facts.near("width after the wheel", (wide[2] - wide[0]) / (right - left), math.exp(-0.2), 0.02)
    facts.near("height after the wheel", (wide[3] - wide[1]) / (bottom - top), math.exp(-0.2), 0.02)
    browser.mouse("mouseWheel", x, y, deltaX=0, deltaY=-200)
    facts.near("picture after the wheel to and fro", browser.picture().differs(first), 0.0, 0.002)

    browser.pinch(200, 100)
    small = browser.picture().body()
    facts.near("width after pinching", (small[2] - small[0]) / (right - left), 0.5, 0.02)
    browser.pinch(100, 200)
    facts.near("picture after pinching to and fro", browser.picture().differs(first), 0.0, 0.002)

    browser.key(",", "Comma", ",")
    facts.near("frame after a key", browser.state("frame"), 0, 0)
    facts.holds("another frame is seen", browser.picture().differs(first) > 0.01)
    browser.key(".", "Period", ".")
    facts.near("picture of the last frame", browser.picture().differs(first), 0.0, 0.0)


def check_space(browser, facts):
    """A body in space turns by as much as the mouse asks for, and back."""
    browser.value("byId('axes').style.visibility = 'hidden'")  # pictures are of the body alone
    first = browser.picture()
    eye = browser.value("eye()")
    letter = "Number([...byId('axes').querySelectorAll('text')].find((name) => name.textContent === 'z').getAttribute('x'))"
    axes = browser.value(letter)
    browser.drag(60, 0)
    turned = browser.picture()
    facts.holds("a turn is seen", turned.differs(first) > 0.05)
    now = browser.value("eye()")
    facts.near("height of the eye", now[1], eye[1], 1e-9)
    angle = math.atan2(eye[0], eye[2]) - math.atan2(now[0], now[2])
    facts.near("angle of a drag", angle, 0.6, 1e-9)
    facts.holds("the axes turn", abs(browser.value(letter) - axes) > 3)
    corners = browser.value("loaded.body.mesh && [0, 3].flatMap((x) => [1, 4].flatMap((y) => [2, 5].map((z) => "
                            "(projected([data.box[x], data.box[y], data.box[z]])[0] - state.center[0]) * pixelsPerLength())))")
    facts.holds("the box of the body holds what is seen", max(corners) - min(corners) > turned.body()[2] - turned.body()[0] - 4)
    browser.drag(-60, 0)
    facts.near("picture after turning to and fro", browser.picture().differs(first), 0.0, 0.005)
    browser.key("ArrowRight")
    browser.key("ArrowLeft")
    facts.near("picture after keys to and fro", browser.picture().differs(first), 0.0, 0.005)
    browser.drag(25, 15, modifiers=8)
    facts.near("picture dragged with Shift", browser.picture().differs(first, 25, 15), 0.0, 0.005)
    browser.key("0", "Digit0", "0")
    x, y = browser.middle
    browser.touch("touchStart", [(x, y)])
    browser.touch("touchMove", [(x + 30, y)])
    browser.touch("touchMove", [(x + 60, y)])
    browser.touch("touchEnd", [])
    facts.near("picture turned by a finger", browser.picture().differs(turned), 0.0, 0.005)


def check_contact(browser, facts):
    """A contact field lies on its face: pressed below the ball, without pressure around, and the body is plain."""
    browser.key("t", "KeyT", "t")
    seen = browser.picture()
    colors = [seen.at(x, y) for y in range(0, seen.height, 2) for x in range(0, seen.width, 2)]
    dark = sum(r < 90 and g < 30 and 60 < b < 110 for r, g, b in colors)
    bright = sum(r > 180 and g > 180 and b < 90 for r, g, b in colors)
    paper = colors[0]
    plain = sum(color != paper and max(color) - min(color) < 12 for color in colors)
    facts.holds(f"most of the face is open ({dark}), some pressed ({bright}), the rest plain ({plain})",
                dark > 1000 and 20 < bright < dark and plain > 1000)
    browser.key("f", "KeyF", "f")
    facts.holds("another field is seen on the body", browser.picture().differs(seen) > 0.05)


def check_narrow(browser, facts):
    """On a narrow screen the scale lies below the body, as wide as the screen, and its numbers stand in their order below it."""
    browser.call("Emulation.setDeviceMetricsOverride", width=420, height=800, deviceScaleFactor=1, mobile=True)
    box = "(({left, top, right, bottom}) => [left, top, right, bottom])(%s.getBoundingClientRect())"
    left, top, right, bottom = browser.value(box % "byId('colors')")
    facts.holds(f"the bar lies ({right - left:g} x {bottom - top:g})", right - left > 300 and bottom - top < 30)
    marks = browser.value(f"[...byId('ticks').children].map((mark) => {box % 'mark'})")
    facts.holds("numbers stand below the bar", all(bottom < mark[1] and -1 <= mark[0] and mark[2] <= 421 for mark in marks))
    facts.holds("numbers grow to the right", marks == sorted(marks))
    facts.holds("the scale leaves the room to the body", browser.value("byId('scale').offsetHeight") < 90)


def main():
    burnish, chromium = sys.argv[1:]
    if not os.path.exists(chromium):
        sys.exit(77)
    facts = Facts()
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as name:
        directory = pathlib.Path(name)
        browser = Browser(chromium, directory / "profile")
        try:
            for kind, scene, check in (("plane", PLANE, check_plane), ("space", SPACE, check_space), ("contact", CONTACT, check_contact)):
                (directory / f"{kind}.yaml").write_text(scene)
                page = directory / f"{kind}.html"
                fields = "contact_pressure,von_mises" if kind == "contact" else "von_mises"
                for arguments in (["run", directory / f"{kind}.yaml", "-o", directory / kind, "--quiet"],
                                  ["view", directory / kind, "-o", page, "--theme", "dark", "--undeformed", "off", "--field", fields]):
                    subprocess.run([burnish, *arguments], check=True, stdout=subprocess.DEVNULL)
                browser.open(page)
                facts.holds("the page has the paper of its theme", browser.picture().at(0, 0) == bytes((0x18, 0x1a, 0x1f)))
                facts.holds("all of it", browser.value("getComputedStyle(document.body).backgroundColor") == "rgb(24, 26, 31)")
                check(browser, facts)
            check_narrow(browser, facts)
            facts.holds(f"the console is empty: {browser.messages}", not browser.messages)
        finally:
            browser.close()
    sys.exit(1 if facts.wrong else 0)


if __name__ == "__main__":
    main()
