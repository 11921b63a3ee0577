"""xdnd.py: drops files onto a window, as a file manager does: the X11 protocol XDND, version 5.

Usage: xdnd.py WINDOW FILE...   WINDOW: its number; exits with 1 if the window refuses the files
       xdnd.py WINDOW --leave   goes before the window answers
"""
import ctypes
import pathlib
import sys
import time

CLIENT_MESSAGE, SELECTION_REQUEST, SELECTION_NOTIFY = 33, 30, 31
VERSION = 5

X = ctypes.CDLL('libX11.so.6')
Id, Display = ctypes.c_ulong, ctypes.c_void_p
X.XOpenDisplay.restype = Display
X.XOpenDisplay.argtypes = [ctypes.c_char_p]
X.XInternAtom.restype = Id
X.XInternAtom.argtypes = [Display, ctypes.c_char_p, ctypes.c_int]
X.XDefaultRootWindow.restype = Id
X.XDefaultRootWindow.argtypes = [Display]
X.XCreateSimpleWindow.restype = Id
X.XCreateSimpleWindow.argtypes = [Display, Id, *[ctypes.c_int] * 2, *[ctypes.c_uint] * 3, Id, Id]
X.XSetSelectionOwner.argtypes = [Display, Id, Id, ctypes.c_ulong]
X.XSendEvent.argtypes = [Display, Id, ctypes.c_int, ctypes.c_long, ctypes.c_void_p]
X.XChangeProperty.argtypes = [Display, Id, Id, Id, ctypes.c_int, ctypes.c_int, ctypes.c_char_p,
                              ctypes.c_int]
X.XNextEvent.argtypes = [Display, ctypes.c_void_p]
X.XPending.argtypes = [Display]
X.XFlush.argtypes = [Display]


class Head(ctypes.Structure):
    """What all these events begin with."""
    _fields_ = [('type', ctypes.c_int), ('serial', Id), ('send', ctypes.c_int),
                ('display', Display)]


class ClientMessage(Head):
    _fields_ = [('window', Id), ('message', Id), ('format', ctypes.c_int), ('data', Id * 5)]


class SelectionRequest(Head):
    _fields_ = [('owner', Id), ('requestor', Id), ('selection', Id), ('target', Id),
                ('property', Id), ('time', Id)]


class SelectionNotify(Head):
    _fields_ = [('requestor', Id), ('selection', Id), ('target', Id), ('property', Id),
                ('time', Id)]


class Event(ctypes.Union):
    _fields_ = [('type', ctypes.c_int), ('client', ClientMessage), ('request', SelectionRequest),
                ('notify', SelectionNotify), ('padding', ctypes.c_long * 24)]


class Source:
    def __init__(self, target, files):
        self.display = X.XOpenDisplay(None)
        if not self.display:
            sys.exit('xdnd.py: no display')
        self.target = target
        self.words = b''.join(pathlib.Path(file).resolve().as_uri().encode() + b'\r\n'
                              for file in files)
        root = X.XDefaultRootWindow(self.display)
        self.window = X.XCreateSimpleWindow(self.display, root, 0, 0, 1, 1, 0, 0, 0)
        X.XSetSelectionOwner(self.display, self.atom('XdndSelection'), self.window, 0)

    def atom(self, name):
        return X.XInternAtom(self.display, name.encode(), 0)

    def send(self, name, *data):
        event = Event(client=ClientMessage(
            type=CLIENT_MESSAGE, display=self.display, window=self.target,
            message=self.atom(name), format=32,
            data=(Id * 5)(self.window, *data, *[0] * (4 - len(data)))))
        X.XSendEvent(self.display, self.target, 0, 0, ctypes.byref(event))
        X.XFlush(self.display)

    def answer(self, request):
        """Gives the list of files to who asks for it."""
        X.XChangeProperty(self.display, request.requestor, request.property, request.target, 8, 0,
                          self.words, len(self.words))
        event = Event(notify=SelectionNotify(
            type=SELECTION_NOTIFY, display=self.display, requestor=request.requestor,
            selection=request.selection, target=request.target, property=request.property,
            time=request.time))
        X.XSendEvent(self.display, request.requestor, 0, 0, ctypes.byref(event))
        X.XFlush(self.display)

    def wait_for(self, name, seconds=60):
        """The message of that name, or None."""
        end = time.monotonic() + seconds
        event = Event()
        while time.monotonic() < end:
            if not X.XPending(self.display):
                time.sleep(0.02)
                continue
            X.XNextEvent(self.display, ctypes.byref(event))
            if event.type == SELECTION_REQUEST:
                self.answer(event.request)
            elif event.type == CLIENT_MESSAGE and event.client.message == self.atom(name):
                return event.client
        return None

    def hover(self):
        self.send('XdndEnter', VERSION << 24, self.atom('text/uri-list'))
        self.send('XdndPosition', 0, 10 << 16 | 10, 0, self.atom('XdndActionCopy'))

    def drop(self):
        """Whether the window took them."""
        self.hover()
        status = self.wait_for('XdndStatus')
        if not status or not status.data[1] & 1:
            return False
        self.send('XdndDrop', 0, 0)
        return self.wait_for('XdndFinished') is not None


if __name__ == '__main__':
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    source = Source(int(sys.argv[1], 0), sys.argv[2:])
    if sys.argv[2] == '--leave':
        source.hover()
        sys.exit()
    sys.exit(0 if source.drop() else 1)
