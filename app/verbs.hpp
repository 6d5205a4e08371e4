// SPDX-License-Identifier: GPL-3.0-or-later
/// The verbs of the command line; each returns the exit code.
#pragma once

#include <string>
#include <vector>

#include "engine/run/march/checkpoints.hpp"
#include "engine/scene/scene.hpp"
#include "engine/study/fit/fit.hpp"
#include "engine/study/gradient/gradient.hpp"
#include "engine/study/gradient/steering.hpp"
#include "engine/study/orbits/orbit_request.hpp"
#include "engine/study/request.hpp"

namespace extremal::app {

/// 0 done; 1 a scheme failed numerically, or a comparison differs; 2 unusable input or arguments; 3 the
/// output could not be written; 130 interrupted.
enum ExitCode { done = 0, failed = 1, unusable = 2, unwritable = 3, interrupted = 130 };

struct CommonOptions {
    std::vector<std::string> overrides;  ///< --set POINTER=VALUE
    std::vector<std::string> added;      ///< --add: names of the user's schemes, or files of schemes
    bool isJson = false;
    bool isQuiet = false;
    bool isTrusted = false;  ///< files that the scene names outside its folder are read
    bool isForced = false;   ///< files of the user are replaced
    unsigned threads = 0;    ///< 0: as many as there are cores
};

struct SnapshotOptions {
    std::string out, view = "all", size = "1200x800", compareWith;
    double time = 0, tolerance = -1;
    bool hasTime = false;
};

struct FigureOptions {
    std::string out;
    std::vector<std::string> views;  ///< empty: those of the scene
    std::string width = "column", legend = "below", colours = "paper", portraits = "beside", times;
    std::string font, caption;
    std::vector<std::string> only;  ///< labels of schemes
    double ratio = 0.7, letters = 8, lines = 0.75;
    int columns = 0, dotsPerInch = 300;
    bool hasTitles = true, isEqual = false, isCaptionDrawn = false;
};

struct PageOptions {
    std::string out;
    int frames = 90;
};

struct RunVerbOptions {
    std::string out;
    bool isResumed = false;
    double checkpoint = CheckpointPlan{}.seconds;  ///< seconds between two; 0: none
};

struct WisdomOptions {
    std::string out;
    std::vector<std::string> modes;  ///< "256" or "256x256"
};

struct StudyOptions : StudyRequest {
    std::string out;
    bool isResumed = false, isPlotted = true;
    std::vector<std::string> folders;  ///< of `study merge`
};

struct AtlasRunOptions {
    std::string out;
    std::vector<std::string> systems;  ///< names of presets; empty: all of the atlas
    bool isQuick = false, isResumed = false;
};

struct PassportRequest {
    std::string scheme;  ///< its label; empty: the first enabled one
    std::string format;  ///< "md", "html" or "tex"; empty: by the ending of the file, else "md"
    std::string out;     ///< empty: standard output
    bool isMeasured = true;
};

struct ProgramRequest {
    std::string scheme;    ///< its label; empty: the first enabled one
    std::string language;  ///< "cpp" or "python"; empty: by the ending of the file
    std::string out;
    std::vector<std::string> with;  ///< pointers to the numbers of its derivative; none: those of the scene
};

struct FormulasRequest {
    std::string out;        ///< empty: standard output
    std::string equations;  ///< "text" or "tex": the equations of motion in place of the scene; else empty
};

struct OrbitOptions : OrbitRequest {
    std::string out;
    std::vector<double> momenta;  ///< between two positions: where Newton's method begins
};

struct FitOptions : FitRequest {
    std::string out, data;
};

struct MotionsOptions {
    std::string out, starts;
    std::string scheme;  ///< its label; empty: the first enabled one
};

struct GradientOptions : GradientRequest {
    std::string out;
};

struct SteerOptions : SteeringRequest {
    std::string out;
};

int runVerb(const std::string& scene, const RunVerbOptions& run, const CommonOptions& options);
/// The motions of one scheme from many starts.
int motionsVerb(const std::string& scene, const MotionsOptions& motions, const CommonOptions& options);
int passportVerb(const std::string& scene, const PassportRequest& request, const CommonOptions& options);
int programVerb(const std::string& scene, const ProgramRequest& request, const CommonOptions& options);
int fitVerb(const std::string& scene, const FitOptions& fit, const CommonOptions& options);
int gradientVerb(const std::string& scene, const GradientOptions& gradient, const CommonOptions& options);
int steerVerb(const std::string& scene, const SteerOptions& steer, const CommonOptions& options);
int orbitVerb(const std::string& scene, const OrbitOptions& orbit, const CommonOptions& options);
/// The scene with its model as a typed Lagrangian.
int formulasVerb(const std::string& scene, const FormulasRequest& request, const CommonOptions& options);
int checkVerb(const std::string& scene, const CommonOptions& options);
int listVerb(const std::string& kind, const CommonOptions& options);
/// A page of the handbook or a section of it ("scenes#views"); empty: the pages there are.
int handbookVerb(const std::string& place, const CommonOptions& options);
int wisdomVerb(const WisdomOptions& wisdom, const CommonOptions& options);
int guiVerb(int argc, char** argv, const std::string& scene, const CommonOptions& options);
int studyVerb(const std::string& scene, const StudyOptions& study, const CommonOptions& options);
int atlasVerb(const AtlasRunOptions& atlas, const CommonOptions& options);
int mergeVerb(const StudyOptions& study, const CommonOptions& options);
/// The scene with a view that was asked for, computed as if the scene had it. Throws SnapshotError where it
/// is not for this scene.
Scene withView(const Scene& scene, const std::string& view);
int snapshotVerb(const std::string& scene, const SnapshotOptions& snapshot, const CommonOptions& options);

int figureVerb(const std::string& scene, const FigureOptions& figure, const CommonOptions& options);

int pageVerb(const std::string& scene, const PageOptions& page, const CommonOptions& options);

/// The version and the commit, on one line.
std::string versionText();
/// The version; with `isVerbose` also the commit, the libraries, the instruction set and what draws.
int versionVerb(bool isVerbose);
/// The completions of bash, zsh or fish, and the manual page, made from the options.
int completionVerb(const std::string& shell);
int manualVerb();

}  // namespace extremal::app
