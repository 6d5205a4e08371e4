// SPDX-License-Identifier: GPL-3.0-or-later
/// The threads of Python that are inside the library.
///
/// When the interpreter ends, a thread that asks for its lock is ended on the spot, in the middle of C++
/// where it is inside the library, which ends the process with an abort. So the library is left before: at
/// exit the calls that are active are asked to stop and waited for, and no further one begins. (Other threads
/// than the main one are still there only if they are daemons.)
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace extremal::python {

class ActiveCalls {
public:
    static ActiveCalls& ofInterpreter() {
        static auto* const calls = new ActiveCalls;  // outlives the interpreter
        return *calls;
    }

    /// With the lock of Python. Once the interpreter is ending, throws in the thread that ends it; others
    /// stay here until the process is gone, as Python itself does with daemon threads.
    void enter() {
        {
            const std::lock_guard lock(mutex_);
            if (!isEnding_) {
                ++count_;
                return;
            }
        }
        if (std::this_thread::get_id() == ending_)
            throw std::runtime_error("the interpreter is ending: no further call is made");
        const pybind11::gil_scoped_release unlocked;
        for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
    }
    void leave() {
        const std::lock_guard lock(mutex_);
        if (--count_ == 0) left_.notify_all();
    }
    bool isEnding() {
        const std::lock_guard lock(mutex_);
        return isEnding_;
    }
    /// Asks all to stop and waits for them, without the lock of Python, which they need to leave. A call that
    /// is held up by a function of Python that does not return is not waited for longer than this.
    void end() {
        std::unique_lock lock(mutex_);
        isEnding_ = true;
        ending_ = std::this_thread::get_id();
        left_.wait_for(lock, std::chrono::seconds(20), [&] { return count_ == 0; });
    }

private:
    std::mutex mutex_;
    std::condition_variable left_;
    std::thread::id ending_;  ///< the thread that ends the interpreter
    int count_ = 0;
    bool isEnding_ = false;
};

/// One call, from before the lock of Python is released until it is held again.
class ActiveCall {
public:
    ActiveCall() { ActiveCalls::ofInterpreter().enter(); }
    ~ActiveCall() { ActiveCalls::ofInterpreter().leave(); }
    ActiveCall(const ActiveCall&) = delete;
    ActiveCall& operator=(const ActiveCall&) = delete;
};

}  // namespace extremal::python
