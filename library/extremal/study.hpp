// SPDX-License-Identifier: GPL-3.0-or-later
/// Studies: many runs of a scene, for orders of convergence, costs, limits of stability.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "extremal/figure.hpp"
#include "extremal/run.hpp"

namespace extremal::api {

/// The options of `extremal study`, by the same names. What is not an option of a study is an error.
struct StudyOptions {
    std::string metric = "error";
    bool isFinal = false;            ///< the metric at the last node; else its maximum over the run
    std::vector<double> steps = {};  ///< empty: chosen by the program, or from, to, points
    double from = 0, to = 0;
    int points = 0;
    double error = 0;                    ///< cheapest: the error to be reached
    std::string x = {}, y = {};          ///< stability, extremes: "POINTER=FROM:TO:N[:log]"
    bool findsLimits = false;            ///< stability: bisect the limit along x
    int repeat = 5;                      ///< timed runs of each point; 0: no times
    std::vector<std::string> only = {};  ///< labels of schemes; empty: all that are enabled
    unsigned threads = 0;
    std::vector<std::string> wishes = {};  ///< cheapest, limits, extremes: "METRIC=VALUE", all must hold
    std::string candidates = {};           ///< cheapest, needs: "scene", or "all" schemes that accept it
    std::string budget = {};               ///< cheapest: CPU time of a run ("1ms") or of its time ("1ms/s")
    std::string searchTime = {};           ///< cheapest: CPU time of the search ("2s"); empty: the usual one
};

struct Table {
    std::string name;
    std::vector<std::string> columns;
    std::vector<std::vector<Value>> rows;  ///< null where a value is not known
};

class EXTREMAL_API Study {
public:
    /// Of the catalogue "studies"; "extremes" with an x, as without it has no scene. Throws InvalidScene; its
    /// pointers are the options of the command line ("--error").
    Study(const std::string& kind, const Scene& scene, const StudyOptions& options = {});
    ~Study();
    Study(const Study&) = delete;
    Study& operator=(const Study&) = delete;

    /// Runs what is not known yet, on all cores. False: `progress` has stopped it; the rest can be run later.
    bool run(const Progress& progress = {});
    bool isComplete() const;
    /// The CSV files of the study; the first has its name.
    std::vector<Table> tables() const;
    std::vector<Figure> figures() const;

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace extremal::api
