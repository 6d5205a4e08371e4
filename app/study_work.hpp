// SPDX-License-Identifier: GPL-3.0-or-later
/// What the verbs that run studies share.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>

#include "app/report.hpp"
#include "app/watch_run.hpp"
#include "engine/core/problem.hpp"
#include "engine/run/files/export.hpp"
#include "engine/study/study_log.hpp"

namespace extremal::app {

/// Does work on another thread, as function(stop), and waits. True: it was interrupted.
template <class Function>
bool workAndWait(const Function& function, std::function<double()> fraction,
                 std::function<std::string()> doing, InterruptWatch& watch, const CommonOptions& options) {
    std::atomic<bool> isFinished{false};
    std::exception_ptr failure;
    std::jthread worker([&](const std::stop_token& stop) {
        try {
            function(stop);
        } catch (...) {
            failure = std::current_exception();
        }
        isFinished = true;
    });
    const Work work{[&] { return isFinished.load(); }, std::move(fraction), std::move(doing),
                    [&] { worker.request_stop(); }};
    const bool isInterrupted = waitFor(work, watch, options);
    worker.join();
    if (failure) std::rethrow_exception(failure);
    return isInterrupted;
}

/// Runs what is not known on another thread and waits. True: it was interrupted.
template <class Study>
bool runAndWait(Study& study, StudyLog& log, InterruptWatch& watch, const CommonOptions& options,
                const std::string& doing = "studying") {
    return workAndWait(
        [&](const std::stop_token& stop) {
            runLines(
                study, [&](const std::string& line) { log.append(line); }, stop);
        },
        [&] { return study.fraction(); },
        [&] { return study.isPreparing() ? std::string("computing the reference") : doing; }, watch, options);
}

/// The exit code of the work, or of the problem that ended it, which is printed.
template <class Function>
int guarded(const std::string& file, Function&& work) {
    try {
        return work();
    } catch (const InvalidScene& e) {
        for (const Problem& p : e.problems()) {
            if (!p.pointer.empty() && p.pointer.front() == '/')
                printProblems(file, {p});
            else
                printProblem(p.pointer, p.message, p.hint);
        }
        return unusable;
    } catch (const ExportError& e) {
        return tellUnwritable(e);
    }
}

}  // namespace extremal::app
