// SPDX-License-Identifier: GPL-3.0-or-later
/// A limit of processor time for work that looks at a stop token.
///
/// What looks at its costs between steps is not in time where one step takes minutes: many unknowns without a
/// second derivative, a step that is far too long for its equations. The iterations of every step look at a
/// stop token, and this one is asked to stop once the thread that works has used its time. A thread of its
/// own looks at the clock every few milliseconds, so that short limits cost nothing and none is exact.
#pragma once

#include <ctime>

#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>

namespace extremal {

class ProcessorWatch {
public:
    ProcessorWatch() = default;
    ProcessorWatch(const ProcessorWatch&) = delete;
    ProcessorWatch& operator=(const ProcessorWatch&) = delete;
    ~ProcessorWatch() = default;

    /// work(stop) in this thread, one at a time; `stop` is requested with `outer`, or after so many seconds
    /// of processor time. True: the time was over.
    template <class Work>
    bool run(double seconds, const std::stop_token& outer, Work&& work) {
        std::stop_source source;
        const std::stop_callback both(outer, [&] { source.request_stop(); });
        const Armed armed(*this, seconds, source);
        std::forward<Work>(work)(source.get_token());
        return source.stop_requested() && !outer.stop_requested();
    }

    /// While it lives, what its thread does counts for nothing: work for others than the one that is watched.
    class Pause {
    public:
        explicit Pause(ProcessorWatch* watch);  ///< null: there is nothing to watch
        ~Pause();
        Pause(const Pause&) = delete;
        Pause& operator=(const Pause&) = delete;

    private:
        ProcessorWatch* watch_;
        double begin_ = 0;
    };

private:
    struct Limit {
        clockid_t clock;
        double end;
        std::stop_source source;
        bool isPaused = false;
    };
    class Armed {
    public:
        Armed(ProcessorWatch& watch, double seconds, const std::stop_source& source);
        ~Armed();
        Armed(const Armed&) = delete;
        Armed& operator=(const Armed&) = delete;

    private:
        ProcessorWatch& watch_;
    };
    void look(const std::stop_token& end);

    std::mutex mutex_;
    std::optional<Limit> limit_;
    std::jthread thread_;  ///< once there is something to watch
};

}  // namespace extremal
