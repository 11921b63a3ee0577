"""x11.py: keys, mouse and pixels of an X server by libX11 and libXtst, to time a window.

A grab of 300x200 pixels takes less than 1 ms on Xvfb; a program such as `import` takes 100.
"""
import ctypes
import ctypes.util

Z_PIXMAP, ALL_PLANES = 2, 0xffffffff


class Image(ctypes.Structure):
    """The first members of XImage."""
    _fields_ = [('width', ctypes.c_int), ('height', ctypes.c_int), ('xoffset', ctypes.c_int),
                ('format', ctypes.c_int), ('data', ctypes.POINTER(ctypes.c_char)),
                ('byte_order', ctypes.c_int), ('bitmap_unit', ctypes.c_int),
                ('bitmap_bit_order', ctypes.c_int), ('bitmap_pad', ctypes.c_int),
                ('depth', ctypes.c_int), ('bytes_per_line', ctypes.c_int)]


class Screen:
    """A connection to the X server of `display`, such as ':99'."""
    def __init__(self, display):
        self.x = ctypes.CDLL('libX11.so.6')
        self.test = ctypes.CDLL('libXtst.so.6')
        pointer = ctypes.c_void_p
        self.x.XOpenDisplay.restype = pointer
        self.x.XDefaultRootWindow.restype = ctypes.c_ulong
        self.x.XDefaultRootWindow.argtypes = [pointer]
        self.x.XGetImage.restype = ctypes.POINTER(Image)
        self.x.XGetImage.argtypes = [pointer, ctypes.c_ulong, *[ctypes.c_int] * 2,
                                     *[ctypes.c_uint] * 2, ctypes.c_ulong, ctypes.c_int]
        self.x.XStringToKeysym.restype = ctypes.c_ulong
        self.x.XKeysymToKeycode.argtypes = [pointer, ctypes.c_ulong]
        self.x.XDestroyImage.argtypes = [ctypes.POINTER(Image)]
        self.x.XFlush.argtypes = self.x.XCloseDisplay.argtypes = [pointer]
        self.test.XTestFakeKeyEvent.argtypes = [pointer, ctypes.c_uint, ctypes.c_int,
                                                ctypes.c_ulong]
        self.test.XTestFakeButtonEvent.argtypes = self.test.XTestFakeKeyEvent.argtypes
        self.test.XTestFakeMotionEvent.argtypes = [pointer, *[ctypes.c_int] * 3, ctypes.c_ulong]
        self.display = self.x.XOpenDisplay(display.encode())
        self.root = self.x.XDefaultRootWindow(self.display)

    def close(self):
        self.x.XCloseDisplay(self.display)

    def grab(self, left, top, width, height):
        """The bytes of these pixels of the screen."""
        image = self.x.XGetImage(self.display, self.root, left, top, width, height, ALL_PLANES,
                                 Z_PIXMAP)
        data = ctypes.string_at(image.contents.data, image.contents.bytes_per_line * height)
        self.x.XDestroyImage(image)
        return data

    def key(self, name):
        code = self.x.XKeysymToKeycode(self.display, self.x.XStringToKeysym(name.encode()))
        for is_down in (1, 0):
            self.test.XTestFakeKeyEvent(self.display, code & 255, is_down, 0)
        self.x.XFlush(self.display)

    def button(self, number, is_down):
        self.test.XTestFakeButtonEvent(self.display, number, is_down, 0)
        self.x.XFlush(self.display)

    def move(self, x, y):
        self.test.XTestFakeMotionEvent(self.display, -1, x, y, 0)
        self.x.XFlush(self.display)
