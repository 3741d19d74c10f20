"""Headless browsers, driven by WebDriver BiDi over a WebSocket: Firefox speaks it itself, Chromium through its driver.

Everything a person does is done by the browser's own input (clicks at places, keys), and everything that it asks the network for and
writes to its console is kept.
"""

from __future__ import annotations

import base64
import contextlib
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time
import urllib.request
import zlib
from collections.abc import Callable
from typing import Any

import websocket

SECONDS = 60
KEYS = {"Tab": "\ue004", "Enter": "\ue007", "Home": "\ue011", "End": "\ue010", "Left": "\ue012", "Right": "\ue014", "Space": " ", "Delete": "\ue017",
        "Control": "\ue009", "Shift": "\ue008"}


class Browser:
    """One window of a browser."""

    def __init__(self, name: str, work: pathlib.Path, dark: bool = False):
        self.name, self.count, self.dark = name, 0, dark
        self.requests: list[str] = []
        self.console: list[str] = []
        work.mkdir(parents=True, exist_ok=True)
        self.profile = work / f"profile-{name}-{'dark' if dark else 'light'}"
        shutil.rmtree(self.profile, ignore_errors=True)
        self.profile.mkdir()
        self.log = open(work / f"{name}.log", "wb")  # noqa: SIM115
        try:
            {"firefox": self._start_firefox, "chromium": self._start_chromium}[name]()
        except BaseException:
            self.process.terminate()
            raise
        self.call("session.subscribe", events=["network.beforeRequestSent", "log.entryAdded"])
        self.context = self.call("browsingContext.getTree")["contexts"][0]["context"]

    def _start_firefox(self) -> None:
        preferences = {"browser.shell.checkDefaultBrowser": False, "datareporting.policy.dataSubmissionEnabled": False, "app.update.enabled": False,
                       "network.captive-portal-service.enabled": False, "ui.prefersReducedMotion": 1, "layout.css.prefers-color-scheme.content-override": 0 if self.dark else 1,
                       "ui.systemUsesDarkTheme": int(self.dark), "intl.accept_languages": "en-US", "remote.prefs.recommended": True}
        lines = "".join(f'user_pref("{key}", {json.dumps(value)});\n' for key, value in preferences.items())
        (self.profile / "user.js").write_text(lines, encoding="utf-8")
        program = shutil.which("firefox-esr") or "firefox"
        self.process = subprocess.Popen([program, "--headless", "--no-remote", "--profile", self.profile, "--remote-debugging-port", "0"],
                                        stdout=self.log, stderr=self.log, start_new_session=True)
        address = self._waited(lambda: re.search(r"WebDriver BiDi listening on (ws://\S+)", self._log_text()))[1]
        self.socket = websocket.create_connection(address + "/session", timeout=SECONDS, suppress_origin=True)
        self.call("session.new", capabilities={})

    def _start_chromium(self) -> None:
        self.process = subprocess.Popen(["chromedriver", "--port=0"], stdout=self.log, stderr=self.log, start_new_session=True)
        port = self._waited(lambda: re.search(r"started successfully on port (\d+)", self._log_text()))[1]
        arguments = ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--hide-scrollbars", "--force-prefers-reduced-motion", "--lang=en-US", "--disable-gpu",
                     f"--user-data-dir={self.profile.resolve()}"] + (["--blink-settings=preferredColorScheme=0"] if self.dark else [])
        wanted = {"capabilities": {"alwaysMatch": {"browserName": "chrome", "webSocketUrl": True, "goog:chromeOptions": {"args": arguments, "binary": shutil.which("chromium")}}}}
        request = urllib.request.Request(f"http://127.0.0.1:{port}/session", json.dumps(wanted).encode(), {"Content-Type": "application/json"})
        with urllib.request.urlopen(request, timeout=SECONDS) as answer:
            address = json.load(answer)["value"]["capabilities"]["webSocketUrl"]
        self.socket = websocket.create_connection(address, timeout=SECONDS, suppress_origin=True)

    def _log_text(self) -> str:
        return pathlib.Path(self.log.name).read_text(encoding="utf-8", errors="replace")

    @staticmethod
    def _waited(question: Callable[[], Any]) -> Any:
        end = time.monotonic() + SECONDS
        while time.monotonic() < end:
            if answer := question():
                return answer
            time.sleep(0.02)
        raise TimeoutError("the browser did not get ready")

    def call(self, method: str, **parameters: Any) -> Any:
        """The answer to a command; events that come before it are kept."""
        self.count += 1
        self.socket.send(json.dumps({"id": self.count, "method": method, "params": parameters}))
        while True:
            message = json.loads(self.socket.recv())
            if message.get("id") == self.count:
                if message["type"] == "error":
                    raise RuntimeError(f"{method}: {message['error']}: {message['message']}")
                return message["result"]
            self._note(message)

    def _note(self, event: dict[str, Any]) -> None:
        if event.get("method") == "network.beforeRequestSent":
            self.requests.append(event["params"]["request"]["url"])
        elif event.get("method") == "log.entryAdded":
            self.console.append(f"{event['params']['level']}: {event['params']['text']}")

    def open(self, page: pathlib.Path | str, part: str = "") -> None:
        """Opens a file, or an address that is given as text."""
        address = page if isinstance(page, str) else page.resolve().as_uri() + part
        self.call("browsingContext.navigate", context=self.context, url=address, wait="complete")
        self.call("browsingContext.activate", context=self.context)

    def size(self, width: int, height: int) -> None:
        self.call("browsingContext.setViewport", context=self.context, viewport={"width": width, "height": height})

    def run(self, script: str) -> Any:
        """The value of an expression in the page, through JSON."""
        done = self.call("script.evaluate", expression=f"Promise.resolve(({script})).then((value) => JSON.stringify(value))", awaitPromise=True, target={"context": self.context})
        if done["type"] == "exception":
            raise RuntimeError(done["exceptionDetails"]["text"])
        return json.loads(done["result"]["value"]) if done["result"]["type"] == "string" else None

    def wait(self, condition: str) -> None:
        try:
            self._waited(lambda: self.run(f"Boolean({condition})"))
        except TimeoutError:
            state = self.run("({...document.documentElement.dataset, hidden: document.hidden, focus: document.activeElement.outerHTML.slice(0, 200)})")
            raise TimeoutError(f"the page did not get to: {condition}; it is {state}, its console {self.console}") from None

    def text(self, identity: str) -> str:
        return str(self.run(f"document.getElementById('{identity}').textContent"))

    def click(self, selector: str, x: float = 0.5, y: float = 0.5) -> None:
        """A click of the mouse at a place of an element, as shares of its size, when the element has stood still for two frames: an answer
        that is drawn meanwhile may move it."""
        place = self.run(f"""(async () => {{
            const e = document.querySelector({json.dumps(selector)}), frame = () => new Promise(requestAnimationFrame);
            let still = 0, before = "", b;
            while (still < 2) {{
              e.scrollIntoView({{block: 'center'}}); await frame(); b = e.getBoundingClientRect();
              const now = [b.left, b.top, b.width, b.height].join(); still = now === before ? still + 1 : 0; before = now;
            }}
            return [Math.round(b.left + {x} * b.width), Math.round(b.top + {y} * b.height)]; }})()""")
        self.call("input.performActions", context=self.context, actions=[{"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"}, "actions": [
            {"type": "pointerMove", "x": place[0], "y": place[1]}, {"type": "pointerDown", "button": 0}, {"type": "pointerUp", "button": 0}]}])

    def press(self, *keys: str) -> None:
        """Keys one after another: names of KEYS, or texts that are typed."""
        letters = [letter for key in keys for letter in (KEYS[key] if key in KEYS else key)]
        actions = [{"type": step, "value": letter} for letter in letters for step in ("keyDown", "keyUp")]
        self.call("input.performActions", context=self.context, actions=[{"type": "key", "id": "keyboard", "actions": actions}])

    def type_into(self, selector: str, text: str) -> None:
        """Clicks a field, selects what it holds and types over it."""
        self.click(selector)
        self.wait(f"document.activeElement === document.querySelector({json.dumps(selector)})")
        control = [{"type": "keyDown", "value": KEYS["Control"]}, {"type": "keyDown", "value": "a"}, {"type": "keyUp", "value": "a"}, {"type": "keyUp", "value": KEYS["Control"]}]
        self.call("input.performActions", context=self.context, actions=[{"type": "key", "id": "keyboard", "actions": control}])
        self.press(text)

    def picture(self, file: pathlib.Path, whole: bool = False) -> None:
        data = self.call("browsingContext.captureScreenshot", context=self.context, origin="document" if whole else "viewport")["data"]
        file.write_bytes(base64.b64decode(data))

    def printed(self) -> bytes:
        return base64.b64decode(self.call("browsingContext.print", context=self.context, background=True, page={"width": 21.0, "height": 29.7})["data"])

    def close(self) -> None:
        try:
            if self.name == "chromium":
                self.call("browser.close")
            else:
                self.call("session.end")
            self.socket.close()
        except (RuntimeError, OSError, websocket.WebSocketException):
            pass
        self.process.terminate()
        self.process.wait(timeout=SECONDS)
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self.process.pid, signal.SIGKILL)  # a browser that did not end by itself
        self.log.close()


def pages_in(pdf: bytes) -> int:
    """How many pages a PDF file has; Firefox packs their list."""
    def unpacked(stream: bytes) -> bytes:
        try:
            return zlib.decompressobj().decompress(stream)
        except zlib.error:
            return b""
    whole = pdf + b"".join(unpacked(found[1]) for found in re.finditer(rb"stream\r?\n(.*?)endstream", pdf, re.DOTALL))
    return len(re.findall(rb"/Type\s*/Page\b", whole))
