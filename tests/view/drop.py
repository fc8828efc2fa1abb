"""Drops files on a window of an X server, as a file manager does (freedesktop.org's XDND protocol, version 5)."""
import ctypes
import os
import urllib.parse

CLIENT_MESSAGE, SELECTION_REQUEST, SELECTION_NOTIFY = 33, 30, 31
PROPERTY_REPLACE = 0


class Event(ctypes.Union):
    """The events that the protocol needs; XEvent is 24 longs."""

    class Client(ctypes.Structure):
        _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("sent", ctypes.c_int),
                    ("display", ctypes.c_void_p), ("window", ctypes.c_ulong), ("message", ctypes.c_ulong),
                    ("format", ctypes.c_int), ("data", ctypes.c_long * 5)]

    class Request(ctypes.Structure):
        _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("sent", ctypes.c_int),
                    ("display", ctypes.c_void_p), ("owner", ctypes.c_ulong), ("requestor", ctypes.c_ulong),
                    ("selection", ctypes.c_ulong), ("target", ctypes.c_ulong), ("property", ctypes.c_ulong),
                    ("time", ctypes.c_ulong)]

    class Notify(ctypes.Structure):
        _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("sent", ctypes.c_int),
                    ("display", ctypes.c_void_p), ("requestor", ctypes.c_ulong), ("selection", ctypes.c_ulong),
                    ("target", ctypes.c_ulong), ("property", ctypes.c_ulong), ("time", ctypes.c_ulong)]

    _fields_ = [("type", ctypes.c_int), ("client", Client), ("request", Request), ("notify", Notify),
                ("pad", ctypes.c_long * 24)]


def drop(display_name, target, paths):
    """Returns the protocol's messages in the order in which the window sent them."""
    x11 = ctypes.CDLL("libX11.so.6")
    x11.XOpenDisplay.restype = ctypes.c_void_p
    x11.XInternAtom.restype = x11.XCreateSimpleWindow.restype = x11.XDefaultRootWindow.restype = ctypes.c_ulong
    display = ctypes.c_void_p(x11.XOpenDisplay(display_name.encode()))

    def atom(name):
        return x11.XInternAtom(display, name.encode(), 0)

    source = x11.XCreateSimpleWindow(display, ctypes.c_ulong(x11.XDefaultRootWindow(display)), 0, 0, 1, 1, 0, 0, 0)
    selection, uris = atom("XdndSelection"), atom("text/uri-list")
    x11.XSetSelectionOwner(display, ctypes.c_ulong(selection), ctypes.c_ulong(source), 0)

    def send(message, *data):
        event = Event()
        event.client.type, event.client.window = CLIENT_MESSAGE, target
        event.client.message, event.client.format = atom(message), 32
        event.client.data[:] = [source, *data, *[0] * (4 - len(data))]
        x11.XSendEvent(display, ctypes.c_ulong(target), 0, 0, ctypes.byref(event))

    def answer(request):
        text = "".join(f"file://{urllib.parse.quote(os.path.abspath(p))}\r\n" for p in paths).encode()
        x11.XChangeProperty(display, ctypes.c_ulong(request.requestor), ctypes.c_ulong(request.property),
                            ctypes.c_ulong(request.target), 8, PROPERTY_REPLACE, text, len(text))
        event = Event()
        event.notify.type, event.notify.requestor, event.notify.selection = SELECTION_NOTIFY, request.requestor, selection
        event.notify.target, event.notify.property, event.notify.time = request.target, request.property, request.time
        x11.XSendEvent(display, ctypes.c_ulong(request.requestor), 0, 0, ctypes.byref(event))

    send("XdndEnter", 5 << 24, uris)
    send("XdndPosition", 0, 300 << 16 | 300, 0, atom("XdndActionCopy"))
    heard = []
    names = {atom(name): name for name in ("XdndStatus", "XdndFinished")}
    while "XdndFinished" not in heard:
        event = Event()
        x11.XNextEvent(display, ctypes.byref(event))
        if event.type == SELECTION_REQUEST:
            answer(event.request)
        if event.type == CLIENT_MESSAGE and event.client.message in names:
            heard.append(names[event.client.message])
            if heard[-1] == "XdndStatus":
                send("XdndDrop", 0, 0)
    x11.XCloseDisplay(display)
    return heard
