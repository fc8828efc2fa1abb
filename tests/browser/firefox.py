"""Firefox for tests of pages: Debian's, driven by WebDriver BiDi, since Debian has no geckodriver.

It runs under Xvfb, because headless it has no WebGL2 without a GPU. The class has those methods of selenium that tests use.
"""
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import tempfile

from wsproto import ConnectionType, WSConnection  # of python3-selenium's dependencies
from wsproto.events import AcceptConnection, Ping, Request, TextMessage

PROGRAM = "/usr/bin/firefox-esr"
LEVELS = {"error": "SEVERE", "warn": "WARNING"}


def why_not():
    """The missing program, or None."""
    return next((f"{name} is not installed" for name in (PROGRAM, "Xvfb") if not shutil.which(name)), None)


class Firefox:
    def __init__(self, seconds):
        self.seconds, self.asked, self.logged = seconds, 0, []
        self.folder = tempfile.TemporaryDirectory(prefix="petzval-firefox-", ignore_cleanup_errors=True)
        pathlib.Path(self.folder.name, "user.js").write_text(
            'user_pref("webgl.force-enabled", true);\nuser_pref("datareporting.policy.dataSubmissionEnabled", false);\n'
            'user_pref("browser.shell.checkDefaultBrowser", false);\n')
        read, write = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1400x1000x24"], pass_fds=[write],
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as display:
            screen = f":{display.readline().strip()}"
        self.process = subprocess.Popen([PROGRAM, "--no-remote", "--profile", self.folder.name, "--remote-debugging-port", "0",
                                         "about:blank"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                                        env={**os.environ, "DISPLAY": screen}, start_new_session=True)
        port = next(int(found[1]) for found in (re.search(r"BiDi listening on ws://.*:(\d+)", line) for line in self.process.stderr)
                    if found)
        self.connect(port)
        self.call("session.new", capabilities={})
        self.call("session.subscribe", events=["log.entryAdded"])
        self.page = self.call("browsingContext.getTree")["contexts"][0]["context"]

    def connect(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=self.seconds)
        self.talk, self.parts = WSConnection(ConnectionType.CLIENT), []
        self.socket.sendall(self.talk.send(Request(host=f"127.0.0.1:{port}", target="/session")))
        while not any(isinstance(event, AcceptConnection) for event in self.events()):
            pass

    def events(self):
        self.talk.receive_data(self.socket.recv(1 << 20) or None)
        for event in self.talk.events():
            if isinstance(event, Ping):
                self.socket.sendall(self.talk.send(event.response()))
            yield event

    def messages(self):
        for event in self.events():
            if isinstance(event, TextMessage):
                self.parts.append(event.data)
                if event.message_finished:
                    yield json.loads("".join(self.parts))
                    self.parts = []

    def call(self, method, **params):
        """A command's result. Lines of the console that come meanwhile are kept."""
        self.asked += 1
        self.socket.sendall(self.talk.send(TextMessage(json.dumps({"id": self.asked, "method": method, "params": params}))))
        answer = None
        while answer is None:
            for message in self.messages():
                if message.get("method") == "log.entryAdded":
                    self.logged.append(message["params"])
                elif message.get("id") == self.asked:
                    answer = message
        if answer["type"] == "error":
            raise RuntimeError(f"{method}: {answer['message']}")
        return answer["result"]

    def function(self, declaration, args):
        done = self.call("script.callFunction", functionDeclaration=declaration, awaitPromise=True,
                         target={"context": self.page}, arguments=[{"type": "string", "value": json.dumps(args)}])
        if done["type"] == "exception":
            raise RuntimeError(done["exceptionDetails"]["text"])
        return json.loads(done["result"]["value"])

    def execute_script(self, script, *args):
        return self.function(f"(args) => JSON.stringify((function () {{ {script}\n }})(...JSON.parse(args)) ?? null)", args)

    def execute_async_script(self, script, *args):
        return self.function("(args) => new Promise((finish) => (function () { "
                             f"{script}\n }})(...JSON.parse(args), (value) => finish(JSON.stringify(value ?? null))))", args)

    def get(self, address):
        self.call("browsingContext.navigate", context=self.page, url=address, wait="complete")

    def set_window_size(self, width, height):
        self.call("browsingContext.setViewport", context=self.page, viewport={"width": width, "height": height})

    def get_log(self, kind):
        """The console since the last call, as Chromium's driver has it."""
        assert kind == "browser", kind
        lines, self.logged = self.logged, []
        return [{"level": LEVELS.get(line["level"], "INFO"), "message": line["text"] or ""} for line in lines]

    def quit(self):
        self.socket.close()
        os.killpg(self.process.pid, signal.SIGTERM)
        self.process.wait()
        self.server.terminate()
        self.server.wait()
        self.folder.cleanup()
