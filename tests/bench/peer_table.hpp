// SPDX-License-Identifier: GPL-3.0-or-later
/// What the table of peers is made of: CPU seconds of whole runs, set-up included, over settings from coarse
/// to fine; the cheapest of ours and of the peers for an error, and their ratio.
///
/// Every run is repeated until 2 ms have passed, and the median of five such measurements counts; runs of 50
/// ms and more are measured once. Between two settings costs are interpolated, log cost over log error.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tests/bench/cpu_time.hpp"

namespace extremal::bench {

/// Whether a peer is a scheme of the framework all the same, in code by hand or as a baseline: what one of
/// ours could cost. By the beginning of its name, behind what says that it is in a single angle.
inline bool isOfFramework(std::string_view name) {
    constexpr std::string_view inOneAngle = "minimal, ";
    if (name.starts_with(inOneAngle)) name.remove_prefix(inOneAngle.size());
    for (const char* const beginning :
         {"SRKN", "S10", "srkn", "blanes-moan", "strang", "suzuki", "impulse", "Gauss", "splitting",
          "arcs by hand", "logarithmic leapfrog", "pairs that turn", "RATTLE", "Deuflhard"})
        if (name.starts_with(beginning)) return true;
    return false;
}

/// What a run says that failed.
inline const std::vector<double> failed{HUGE_VAL};

struct Point {
    double error, time;
};

/// CPU seconds for an error, the least of those that reach it: finer settings may cost less than coarser
/// ones, where these iterate longer. NaN if it is not reached.
inline double costAt(const std::vector<Point>& points, double error) {
    double least = std::nan("");
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!(points[i].error <= error)) continue;
        double time = points[i].time;
        if (i > 0 && points[i - 1].error > error && points[i].error > 0) {
            const double w =
                std::log(points[i - 1].error / error) / std::log(points[i - 1].error / points[i].error);
            time = std::exp(std::log(points[i - 1].time) + w * std::log(time / points[i - 1].time));
        }
        if (!(time >= least)) least = time;
    }
    return least;
}

/// Median CPU seconds of one call; `first` is what a call took.
inline double secondsOf(const std::function<void()>& run, double first) {
    if (first >= 0.05) return first;
    const int together = std::max(1, static_cast<int>(2e-3 / std::max(first, 1e-7)));
    std::vector<double> samples;
    for (int k = 0; k < 5; ++k) {
        const double start = cpuSeconds();
        for (int i = 0; i < together; ++i) run();
        samples.push_back((cpuSeconds() - start) / together);
    }
    std::nth_element(samples.begin(), samples.begin() + 2, samples.end());
    return samples[2];
}

/// A code over its settings; of several errors (an angle, an extension) of the same runs each has a curve.
struct Curve {
    std::string name;
    bool isPeer;
    std::vector<std::vector<Point>> errors;
};

/// `run(setting)`: its errors, not finite where it failed. Ends behind the first run that takes longer than
/// `longest`, or where round-off lets no error fall any more: six in a row.
inline Curve measure(const std::string& name, bool isPeer, const std::vector<double>& settings,
                     double longest, const std::function<std::vector<double>(double)>& run) {
    Curve curve{name, isPeer, {}};
    double best = HUGE_VAL;
    int inVain = 0;
    (void)run(settings.front());  // tables, plans and caches
    for (const double setting : settings) {
        const double start = cpuSeconds();
        const std::vector<double> errors = run(setting);
        const double first = cpuSeconds() - start;
        curve.errors.resize(errors.size());
        const double largest = *std::max_element(errors.begin(), errors.end());
        const bool isUseful = std::any_of(errors.begin(), errors.end(), [](double e) { return e < 0.3; });
        if (isUseful) {
            const double seconds = secondsOf([&] { (void)run(setting); }, first);
            for (std::size_t i = 0; i < errors.size(); ++i) curve.errors[i].push_back({errors[i], seconds});
        }
        inVain = largest < 1e-9 && largest > 0.9 * best ? inVain + 1 : 0;
        if (first > longest || inVain == 6) break;
        if (std::isfinite(largest)) best = std::min(best, largest);
    }
    return curve;
}

/// Those of a problem: the ones it names, or all.
struct Curves {
    double longest;
    std::set<std::string> only = {};
    std::vector<Curve> all = {};

    void add(const std::string& name, bool isPeer, const std::vector<double>& settings,
             const std::function<std::vector<double>(double)>& run) {
        if (only.empty() || only.contains(name)) all.push_back(measure(name, isPeer, settings, longest, run));
    }
};

inline std::vector<double> ratios(double from, double to, double factor) {
    std::vector<double> all;
    for (double v = from; factor > 1 ? v <= to * (1 + 1e-9) : v >= to * (1 - 1e-9); v *= factor)
        all.push_back(v);
    return all;
}
/// Numbers of steps.
inline std::vector<double> counts(double from, double to, double factor) {
    std::vector<double> all;
    for (const double v : ratios(from, to, factor))
        if (all.empty() || std::floor(v) > all.back()) all.push_back(std::floor(v));
    return all;
}

class PeerTable {
public:
    static constexpr double targets[] = {1e-3, 1e-6, 1e-9, 1e-12};

    /// One row: a problem, with the index of its error in the curves, against the peers whose names begin so.
    void add(const std::string& problem, const std::vector<Curve>& curves, std::size_t error,
             const std::string& peers = "") {
        Row row{problem, std::vector<Cell>(std::size(targets)), {}};
        for (const Curve& curve : curves) {
            if (error >= curve.errors.size()) continue;
            row.curves.push_back({curve.name, curve.isPeer, {}});
            for (std::size_t i = 0; i < std::size(targets); ++i) {
                const double cost = costAt(curve.errors[error], targets[i]);
                row.curves.back().seconds.push_back(cost);
                if (curve.isPeer && !curve.name.starts_with(peers)) continue;
                const bool isOurKind = !curve.isPeer || isOfFramework(curve.name);
                Cell& cell = row.cells[i];
                for (Best* best :
                     {curve.isPeer ? &cell.peer : &cell.ours, isOurKind ? &cell.framework : &cell.others})
                    if (cost < best->seconds) *best = {cost, curve.name};
            }
        }
        rows_.push_back(row);
        print(row);
    }
    void printHeading() const {
        std::printf("%-24s", "ours / best peer at");
        for (const double t : targets) std::printf("%8.0e", t);
        std::printf("   ours and the best peer, CPU seconds\n");
    }
    /// One line per problem and code: the seconds for each error, empty where it is not reached.
    bool writeCurves(const char* path) const {
        std::FILE* file = std::fopen(path, "w");
        if (!file) return false;
        std::fprintf(file, "problem,code,peer");
        for (const double t : targets) std::fprintf(file, ",seconds_for_%g", t);
        std::fprintf(file, "\n");
        for (const Row& row : rows_)
            for (const Costs& c : row.curves) {
                std::fprintf(file, "\"%s\",\"%s\",%d", row.problem.c_str(), c.name.c_str(), c.isPeer);
                for (const double s : c.seconds) std::fprintf(file, ",%s", number(s).c_str());
                std::fprintf(file, "\n");
            }
        return std::fclose(file) == 0;
    }
    /// One line per problem and error.
    bool writeCsv(const char* path) const {
        std::FILE* file = std::fopen(path, "w");
        if (!file) return false;
        std::fprintf(file, "problem,error,ours,ours_seconds,peer,peer_seconds,ratio\n");
        for (const Row& row : rows_)
            for (std::size_t i = 0; i < row.cells.size(); ++i) {
                const Cell& c = row.cells[i];
                std::fprintf(file, "\"%s\",%g,%s,%s,%s,%s,%s\n", row.problem.c_str(), targets[i],
                             c.ours.name.c_str(), number(c.ours.seconds).c_str(), c.peer.name.c_str(),
                             number(c.peer.seconds).c_str(), number(c.ratio()).c_str());
            }
        return std::fclose(file) == 0;
    }

private:
    struct Best {
        double seconds = HUGE_VAL;
        std::string name;
    };
    struct Cell {
        Best ours, peer;
        Best framework, others;  ///< the same codes, by what they are: isOfFramework()
        double ratio() const { return ours.seconds / peer.seconds; }
    };
    /// What a code costs at the targets.
    struct Costs {
        std::string name;
        bool isPeer;
        std::vector<double> seconds;
    };
    struct Row {
        std::string problem;
        std::vector<Cell> cells;
        std::vector<Costs> curves;
    };
    static std::string number(double value) {
        char text[32] = "";
        if (std::isfinite(value) && value > 0) std::snprintf(text, sizeof text, "%.4g", value);
        return text;
    }
    /// "-": neither reaches the error; "none": ours does not; "alone": no peer does.
    static void printRatio(const Best& ours, const Best& peer) {
        const bool isOurs = std::isfinite(ours.seconds), isPeer = std::isfinite(peer.seconds);
        if (isOurs && isPeer)
            std::printf("%8.3g", ours.seconds / peer.seconds);
        else
            std::printf("%8s", isOurs ? "alone" : isPeer ? "none" : "-");
    }
    /// Where a cell is above 1, a second line says what the cheapest code of the framework by anyone costs
    /// against the best of all others: ours cannot cost less than that by better code alone.
    static void print(const Row& row) {
        std::printf("%-24s", row.problem.c_str());
        for (const Cell& c : row.cells) printRatio(c.ours, c.peer);
        std::printf("  ");
        for (const Cell& c : row.cells)
            if (std::isfinite(c.ours.seconds) || std::isfinite(c.peer.seconds))
                std::printf(" | %s %s : %s %s", c.ours.name.c_str(), number(c.ours.seconds).c_str(),
                            c.peer.name.c_str(), number(c.peer.seconds).c_str());
        std::printf("\n");
        if (std::any_of(row.cells.begin(), row.cells.end(), [](const Cell& c) { return c.ratio() > 1; })) {
            std::printf("%-24s", "    framework : others");
            for (const Cell& c : row.cells) printRatio(c.framework, c.others);
            std::printf("  ");
            for (const Cell& c : row.cells)
                if (std::isfinite(c.framework.seconds))
                    std::printf(" | %s : %s", c.framework.name.c_str(), c.others.name.c_str());
            std::printf("\n");
        }
        std::fflush(stdout);
    }

    std::vector<Row> rows_;
};

}  // namespace extremal::bench
