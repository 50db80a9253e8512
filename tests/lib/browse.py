"""Chromium without a window, by chromedriver's own protocol (W3C WebDriver), with the standard library alone.

    with Browser("gallery.html", dark=True) as b: b.run("return document.title"); b.press("n"); b.shot("page.png")
"""
import base64
import json
import os
import socket
import subprocess
import time
import urllib.request


class Browser:
    def __init__(self, page, dark=False, size="1280,800"):
        with socket.socket() as s:
            s.bind(("127.0.0.1", 0))
            port = s.getsockname()[1]
        self.driver = subprocess.Popen(["chromedriver", f"--port={port}"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.at = f"http://127.0.0.1:{port}"
        self.session = ""
        options = ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--mute-audio", "--no-first-run",
                   "--autoplay-policy=no-user-gesture-required", "--window-size=" + size] + ["--blink-settings=preferredColorScheme=0"] * dark
        asked = {"capabilities": {"alwaysMatch": {"browserName": "chrome", "goog:chromeOptions": {"args": options},
                                                  "goog:loggingPrefs": {"browser": "ALL"}}}}
        try:
            for left in range(100, -1, -1):
                try:
                    self.session = "/session/" + self.call("/session", asked)["sessionId"]
                    break
                except urllib.error.URLError as e:
                    if isinstance(e, urllib.error.HTTPError) or left == 0:
                        raise
                    time.sleep(0.1)
            self.call("/url", {"url": "file://" + os.path.abspath(page)})
        except BaseException:
            self.__exit__()
            raise

    def call(self, what, body=None, method=None):
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.at + self.session + what, data, {"Content-Type": "application/json"}, method=method)
        with urllib.request.urlopen(request, timeout=120) as answer:
            return json.load(answer)["value"]

    def run(self, script):
        """What the script returns."""
        return self.call("/execute/sync", {"script": script, "args": []})

    def until(self, script, seconds=20):
        """Waits until it returns something true, and returns that."""
        end = time.time() + seconds
        while not (value := self.run(script)):
            assert time.time() < end, "never: " + script
            time.sleep(0.05)
        return value

    def press(self, keys):
        events = [{"type": t, "value": k} for k in keys for t in ("keyDown", "keyUp")]
        self.call("/actions", {"actions": [{"type": "key", "id": "keys", "actions": events}]})

    def complaints(self):
        """What the browser's console says."""
        return [entry["message"] for entry in self.call("/se/log", {"type": "browser"})]

    def shot(self, file):
        with open(file, "wb") as f:
            f.write(base64.b64decode(self.call("/screenshot")))

    def __enter__(self):
        return self

    def __exit__(self, *why):
        try:
            if self.session:
                self.call("", method="DELETE")
        finally:
            self.driver.terminate()
            self.driver.wait()
