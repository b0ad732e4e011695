"""A headless Chromium by WebDriver (https://www.w3.org/TR/webdriver2/), by Python's own library alone."""
import json
import os
import re
import subprocess
import time
import urllib.error
import urllib.request

ELEMENT = "element-6066-11e4-a52e-4f735466cecf"  # the key of an element's id, by the standard
KEYS = {"space": " ", "left": "\ue012", "right": "\ue014", "home": "\ue011", "end": "\ue010", "enter": "\ue007", "escape": "\ue00c"}


class Browser:
    """One window. `phone`: its width in CSS pixels, as a telephone's; `javascript`: whether pages may use it."""

    def __init__(self, width=1280, height=1600, phone=None, javascript=True):
        self.driver = subprocess.Popen(["chromedriver", "--port=0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        for line in self.driver.stdout:
            started = re.search(r"started successfully on port (\d+)", line)
            if started:
                break
        else:
            raise RuntimeError("chromedriver did not start")
        self.base = "http://127.0.0.1:" + started.group(1)
        arguments = ["--headless=new", "--disable-gpu", "--hide-scrollbars", "--window-size=%d,%d" % (width, height)]
        if os.geteuid() == 0:
            arguments.append("--no-sandbox")
        options = {"args": arguments}
        if phone:
            options["mobileEmulation"] = {"deviceMetrics": {"width": phone, "height": height, "pixelRatio": 1.0}}
        if not javascript:
            options["prefs"] = {"profile.managed_default_content_settings.javascript": 2}
        wanted = {"browserName": "chrome", "goog:chromeOptions": options, "goog:loggingPrefs": {"browser": "ALL"}}
        try:
            session = self._call("POST", "/session", {"capabilities": {"alwaysMatch": wanted}})
        except Exception:
            self.driver.kill()
            raise
        self.base += "/session/" + session["sessionId"]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self._call("DELETE", "")
        finally:
            self.driver.terminate()
            self.driver.wait()

    def _call(self, method, path, body=None):
        data = json.dumps(body or {}).encode() if method == "POST" else None
        request = urllib.request.Request(self.base + path, data, {"Content-Type": "application/json"}, method=method)
        try:
            with urllib.request.urlopen(request, timeout=60) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(json.load(error)["value"]["message"].splitlines()[0]) from None

    def open(self, url):
        self._call("POST", "/url", {"url": url})

    def reload(self):
        self._call("POST", "/refresh")

    def find(self, css):
        return self._call("POST", "/element", {"using": "css selector", "value": css})[ELEMENT]

    def click(self, css):
        self._call("POST", "/element/%s/click" % self.find(css))

    def click_at(self, css, x, y=0.5):
        """A click of the mouse at a fraction of the element's width and height, after it is scrolled into sight."""
        box = self.script("const e = document.querySelector(arguments[0]); e.scrollIntoView({block: 'center'});"
                          "const b = e.getBoundingClientRect(); return [b.left, b.top, b.width, b.height];", css)
        at = {"x": round(box[0] + x * (box[2] - 1)), "y": round(box[1] + y * (box[3] - 1))}
        self._pointer([{"type": "pointerMove", "duration": 0, **at}, {"type": "pointerDown", "button": 0},
                       {"type": "pointerUp", "button": 0}])

    def hover_at(self, css, x, y=0.5):
        box = self.script("const e = document.querySelector(arguments[0]); e.scrollIntoView({block: 'center'});"
                          "const b = e.getBoundingClientRect(); return [b.left, b.top, b.width, b.height];", css)
        self._pointer([{"type": "pointerMove", "duration": 0, "x": round(box[0] + x * (box[2] - 1)), "y": round(box[1] + y * (box[3] - 1))}])

    def _pointer(self, actions):
        self._call("POST", "/actions", {"actions": [{"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"}, "actions": actions}]})

    def key(self, name):
        """A key goes to what has the focus."""
        value = KEYS.get(name, name)
        self._call("POST", "/actions", {"actions": [{"type": "key", "id": "keys", "actions": [
            {"type": "keyDown", "value": value}, {"type": "keyUp", "value": value}]}]})

    def text(self, css):
        return self._call("GET", "/element/%s/text" % self.find(css))

    def is_shown(self, css):
        return self._call("GET", "/element/%s/displayed" % self.find(css))

    def script(self, source, *arguments):
        return self._call("POST", "/execute/sync", {"script": source, "args": list(arguments)})

    def console(self):
        """What the page complained of since the last call."""
        return [entry["message"] for entry in self._call("POST", "/se/log", {"type": "browser"}) if entry["level"] in ("SEVERE", "WARNING")]

    def until(self, holds, what, seconds=10):
        end = time.monotonic() + seconds
        while not holds():
            if time.monotonic() > end:
                raise AssertionError("not within %g s: %s" % (seconds, what))
            time.sleep(0.02)


def expect(found, wanted, what):
    if found != wanted:
        raise AssertionError("%s: %r, not %r" % (what, found, wanted))
