// SPDX-License-Identifier: GPL-3.0-or-later
/// What the verbs share that run studies, and those whose answer is files.
#pragma once

#include <atomic>
#include <exception>
#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/load.hpp"
#include "app/report.hpp"
#include "app/watch_run.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/run/files/answer_files.hpp"
#include "engine/run/files/export.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/study/study_log.hpp"

namespace extremal::app {

/// Does work on another thread, as function(stop), and waits. True: it was interrupted.
template <class Function>
bool workAndWait(const Function& function, std::function<double()> fraction,
                 std::function<std::string()> doing, InterruptWatch& watch, const CommonOptions& options,
                 std::function<AnnouncedTime()> announced = {}) {
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
                    [&] { worker.request_stop(); }, std::move(announced)};
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
        [&] { return study.isPreparing() ? std::string("computing the reference") : doing; }, watch, options,
        [&] { return study.announced(); });
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

/// A verb whose answer is files in --out: fit, gradient, steer. Answer: with isFound(), and where it is not,
/// scheme, problem and remedy.
template <class Answer>
struct AnswerVerb {
    std::string out;                  ///< the folder
    std::vector<std::string> files;   ///< all that are written there
    std::vector<std::string> inputs;  ///< files that are read besides the scene
    std::string doing;                ///< "fitting"
    std::string unknown;              ///< after an interruption: "no minimum is known yet"
    std::function<Answer(const ResolvedScene&, const std::stop_token&)> work;
    std::function<Value(const Answer&)> document;
    std::function<AnswerFiles(const Answer&, const Value& document)> written;
    std::function<std::string(const Answer&)> text;
};

/// The exit code. No work is begun whose files could not be written.
template <class Answer>
int runAnswerVerb(const std::string& scene, const AnswerVerb<Answer>& verb, const CommonOptions& options) {
    const ReadScene read = loadScene(scene, options);
    if (!reportScene(scene, read, options)) return unusable;
    return guarded(sceneName(scene), [&] {
        const Replacing replacing = replacingOf(scene, read, options, verb.inputs);
        for (const std::string& file : verb.files)
            requireReplaceable(std::filesystem::path(verb.out) / file, replacing);
        InterruptWatch watch;
        Answer answer;
        const bool isInterrupted =
            workAndWait([&](const std::stop_token& stop) { answer = verb.work(*read.resolved, stop); },
                        [] { return 0.0; }, [&] { return verb.doing; }, watch, options);
        if (isInterrupted) {
            printProblem("", "interrupted: " + verb.unknown);
            return static_cast<int>(interrupted);
        }
        const Value document = verb.document(answer);
        if (!answer.isFound()) {
            printProblem(sceneName(scene) + ": " + answer.scheme, answer.problem, answer.remedy);
            return options.isJson ? print(writeJson(document), failed) : static_cast<int>(failed);
        }
        writeAnswer(verb.written(answer, document), verb.out, replacing);
        if (options.isJson) return print(writeJson(document), done);
        if (options.isQuiet) return static_cast<int>(done);
        return print(verb.text(answer) + "\n" + joinNames(verb.files) + " in " + verb.out + "\n", done);
    });
}

}  // namespace extremal::app
