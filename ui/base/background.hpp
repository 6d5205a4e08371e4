// SPDX-License-Identifier: GPL-3.0-or-later
/// Work of the window that takes a while, on threads of its own.
///
/// Not on the global pool of Qt: painting divides its work among those threads and waits for them, so that a
/// long task there would stall the window.
#pragma once

#include <functional>

namespace extremal {

/// On one of as many threads as the machine has cores, shared by all windows of the application, which waits
/// for them when it ends. From the window's thread.
void runInBackground(std::function<void()> work);

/// What such work has found: runs on the window's thread, after what was sent before. From the threads above,
/// with a QPointer to the receiver, which may be gone by then.
void sendToWindow(std::function<void()> message);

/// While there is one, such messages wait: for an event loop inside an event, where what they do could remove
/// what the event comes from. On the window's thread.
class HeldMessages {
public:
    HeldMessages();
    ~HeldMessages();
    HeldMessages(const HeldMessages&) = delete;
    HeldMessages& operator=(const HeldMessages&) = delete;
};

}  // namespace extremal
