// SPDX-License-Identifier: GPL-3.0-or-later
/// The program: a verb of the command line, or the window.
#include <QHashFunctions>

#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>

#include "app/arguments.hpp"
#include "app/report.hpp"
#include "app/verbs.hpp"
#include "engine/core/problem.hpp"
#include "engine/model/wave/basis/wisdom.hpp"
#include "engine/run/files/export.hpp"

namespace {

int dispatch(int argc, char** argv) {
    using namespace extremal::app;
    int exitCode = done;
    const auto arguments = parseArguments(argc, argv, exitCode);
    if (!arguments) return exitCode;
    if (arguments->isVersion) return versionVerb(arguments->isVerbose);
    if (arguments->verb == "completion") return completionVerb(arguments->kind);
    if (arguments->verb == "manual") return manualVerb();
    if (arguments->verb == "wisdom") return wisdomVerb(arguments->wisdom, arguments->common);
    if (const char* file = std::getenv("EXTREMAL_WISDOM"); file && *file) {
        try {
            extremal::useWisdom(file);
        } catch (const std::runtime_error& e) {
            printProblem("EXTREMAL_WISDOM", e.what(), "extremal wisdom --out FILE --modes N makes one");
            return unusable;
        }
    }
    if (arguments->verb == "run") return runVerb(arguments->scene, arguments->run, arguments->common);
    if (arguments->verb == "study") return studyVerb(arguments->scene, arguments->study, arguments->common);
    if (arguments->verb == "atlas") return atlasVerb(arguments->atlas, arguments->common);
    if (arguments->verb == "study merge") return mergeVerb(arguments->study, arguments->common);
    if (arguments->verb == "passport")
        return passportVerb(arguments->scene, arguments->passport, arguments->common);
    if (arguments->verb == "program")
        return programVerb(arguments->scene, arguments->program, arguments->common);
    if (arguments->verb == "orbit") return orbitVerb(arguments->scene, arguments->orbit, arguments->common);
    if (arguments->verb == "gradient")
        return gradientVerb(arguments->scene, arguments->gradient, arguments->common);
    if (arguments->verb == "steer") return steerVerb(arguments->scene, arguments->steer, arguments->common);
    if (arguments->verb == "motions")
        return motionsVerb(arguments->scene, arguments->motions, arguments->common);
    if (arguments->verb == "fit") return fitVerb(arguments->scene, arguments->fit, arguments->common);
    if (arguments->verb == "formulas")
        return formulasVerb(arguments->scene, arguments->formulas, arguments->common);
    if (arguments->verb == "check") return checkVerb(arguments->scene, arguments->common);
    if (arguments->verb == "handbook") return handbookVerb(arguments->kind, arguments->common);
    if (arguments->verb == "list") return listVerb(arguments->kind, arguments->common);
    if (arguments->verb == "page") return pageVerb(arguments->scene, arguments->page, arguments->common);
    if (arguments->verb == "figure")
        return figureVerb(arguments->scene, arguments->figure, arguments->common);
    if (arguments->verb == "snapshot")
        return snapshotVerb(arguments->scene, arguments->snapshot, arguments->common);
    return guiVerb(argc, argv, arguments->scene, arguments->common);
}

}  // namespace

int main(int argc, char** argv) {
    // A file that grows beyond a limit is an error of its write, with a message, and not the end of the
    // program.
    std::signal(SIGXFSZ, SIG_IGN);
    // The contents of a PDF depend on the order of hash tables: the same picture must give the same bytes.
    QHashSeed::setDeterministicGlobalSeed();
    try {
        return dispatch(argc, argv);
    } catch (const std::bad_alloc&) {
        extremal::app::printProblem("", "out of memory", "fewer schemes at once: --threads 1, or fewer rows");
    } catch (const extremal::ExportError& e) {
        extremal::app::printProblem(e.path.string(), std::string("cannot be written: ") + e.what());
        return extremal::app::unwritable;
    } catch (const std::filesystem::filesystem_error& e) {
        extremal::app::printProblem(e.path1().string(), e.code().message(), "another file or folder");
        return extremal::app::unwritable;
    } catch (const extremal::InvalidScene& e) {
        extremal::app::printProblems("", e.problems());
        return extremal::app::unusable;
    } catch (const std::exception& e) {
        // A fault of the program: every cause that is known has its own message.
        extremal::app::printProblem("internal error", e.what(), "please report it, with the command");
    }
    return extremal::app::failed;
}
