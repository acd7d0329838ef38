#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""In place of ssh and sshd between the hosts of a test: remote_shell.py HOST COMMAND...; remote_shell.py --serve

As over ssh, what is behind HOST goes to a shell there, nothing of the caller's environment arrives, and it all takes the hosts'
network. There are no passwords: the network is the test's own. The exit code is not brought back.
"""
import os
import signal
import socket
import subprocess
import sys

PORT = 22
END = b"\0"


def serve():
    """As the first process of a host: it also buries whoever dies without a parent."""
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)
    with socket.create_server(("", PORT)) as server:
        while True:
            caller, _ = server.accept()
            with caller:
                command = b""
                while not command.endswith(END):
                    command += caller.recv(65536) or END
                subprocess.Popen(["sh", "-c", command[:-1]], stdin=subprocess.DEVNULL, stdout=caller, stderr=caller,
                                 start_new_session=True, cwd="/")


def call(host, words):
    with socket.create_connection((host, PORT), timeout=20) as server:
        server.settimeout(None)
        server.sendall(os.fsencode(" ".join(words)) + END)
        while said := server.recv(65536):
            sys.stdout.buffer.write(said)
            sys.stdout.flush()


if __name__ == "__main__":
    if sys.argv[1:] == ["--serve"]:
        serve()
    call(sys.argv[1], sys.argv[2:])
