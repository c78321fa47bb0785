#include "support/window_user.h"

// Xlib's macros stay in here.
#include <X11/Xlib.h>
#include <poll.h>

#include <chrono>
#include <stdexcept>

namespace cpslam::test {

struct WindowUser::Connection {
  Connection() : display(XOpenDisplay(nullptr)) {
    if (display == nullptr) throw std::runtime_error("no display");
  }
  ~Connection() { XCloseDisplay(display); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// 0 while there is none.
  [[nodiscard]] Window find(const std::string& name) const {
    Window root = 0;
    Window parent = 0;
    Window* children = nullptr;
    unsigned n_children = 0;
    Window found = 0;
    XQueryTree(display, DefaultRootWindow(display), &root, &parent, &children, &n_children);
    for (unsigned i = 0; i < n_children; ++i) {
      XWindowAttributes attributes;
      char* title = nullptr;
      const bool shown = XGetWindowAttributes(display, children[i], &attributes) != 0 &&
                         attributes.map_state == IsViewable && XFetchName(display, children[i], &title) != 0;
      if (shown && name == title) found = children[i];
      if (title != nullptr) XFree(title);
    }
    if (children != nullptr) XFree(children);
    return found;
  }

  Display* display;
  Window window = 0;
};

WindowUser::WindowUser(const std::string& name) : connection_(std::make_unique<Connection>()) {
  Display* const display = connection_->display;
  // Every change among the screen's windows is an event, so that there is something to wait for.
  XSelectInput(display, DefaultRootWindow(display), SubstructureNotifyMask);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while ((connection_->window = connection_->find(name)) == 0) {
    if (std::chrono::steady_clock::now() > deadline) throw std::runtime_error("no window '" + name + "'");
    XSync(display, True);
    pollfd events{ConnectionNumber(display), POLLIN, 0};
    poll(&events, 1, 100);
  }
}

WindowUser::~WindowUser() = default;

void WindowUser::press(const std::string& key) const {
  Display* const display = connection_->display;
  const Window window = connection_->window;
  XEvent event{};
  event.xkey.display = display;
  event.xkey.window = window;
  event.xkey.root = DefaultRootWindow(display);
  event.xkey.same_screen = True;
  event.xkey.keycode = XKeysymToKeycode(display, XStringToKeysym(key.c_str()));
  for (const int type : {KeyPress, KeyRelease}) {
    event.type = type;
    XSendEvent(display, window, True, type == KeyPress ? KeyPressMask : KeyReleaseMask, &event);
  }
  XFlush(display);
}

void WindowUser::close() const {
  Display* const display = connection_->display;
  const Window window = connection_->window;
  XEvent event{};
  event.type = ClientMessage;
  event.xclient.window = window;
  event.xclient.message_type = XInternAtom(display, "WM_PROTOCOLS", False);
  event.xclient.format = 32;
  event.xclient.data.l[0] = static_cast<long>(XInternAtom(display, "WM_DELETE_WINDOW", False));
  XSendEvent(display, window, False, NoEventMask, &event);
  XFlush(display);
}

}  // namespace cpslam::test
