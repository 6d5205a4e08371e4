// SPDX-License-Identifier: GPL-3.0-or-later
/// The cheapest of some schemes for a wish, by a race (candidate_race.hpp), and of each scheme of the scene
/// the smallest degree and the fewest nodes that are enough. Of schemes of fields the number of elements and
/// the steps are searched together (mesh_fit.hpp), before the race of the others.
///
/// Costs are CPU seconds, or, where runs are not timed, evaluations (steps times nodes where none are
/// counted; of meshes finer than that of the scene as many times more as they have unknowns), which are the
/// same on every machine: so is then everything that is found. Runs are remembered: a second wish begins with
/// those of the first.
#pragma once

#include <functional>
#include <iterator>
#include <map>
#include <span>
#include <stop_token>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/run/comparison.hpp"
#include "engine/study/search/candidate_race.hpp"
#include "engine/study/search/knobs.hpp"
#include "engine/study/search/mesh_fit.hpp"
#include "engine/study/search/point.hpp"
#include "engine/study/search/search_cases.hpp"

namespace extremal {

/// A scheme that is searched.
struct SearchedScheme {
    StudyPoint point;  ///< as the scene has it
    /// Searched while it costs at most so many times the cheapest, and with smaller degrees: a scheme of the
    /// scene. Else while it may be the cheapest.
    bool isOfScene = true;
};

class CandidateSearch {
public:
    /// A reference to run a point against.
    using References = std::function<ExactSolution(const StudyPoint&)>;

    /// `seconds`: of CPU for all searches together; infinity: no limit. `isCounted`: costs are evaluations.
    CandidateSearch(const ResolvedScene& scene, std::vector<SearchedScheme> schemes,
                    std::vector<Metric> metrics, References references, ReferenceInfo reference,
                    bool isCounted, double seconds, const std::stop_token& stop);

    /// Errors are the largest, or the middle ones, of these in place of the scene's; of the largest the case
    /// that failed last is run first, and a setting that fails there is not run on the others.
    void judgeOver(std::vector<SearchCase> cases, bool isMedian) {
        cases_ = std::move(cases);
        isMedian_ = isMedian;
    }

    void setKnobs(SearchKnobs knobs) { knobs_ = knobs; }
    /// Schemes that hold more are refused (CostLimit::bytes).
    void setMostBytes(double bytes) { mostBytes_ = bytes; }

    /// One result per scheme: what reaches the wishes, one per metric, at the lowest cost, with status done;
    /// else the nearest, with status failed and the reason. Those that reach it are timed `repeat` times,
    /// of schemes that are not of the scene the best three.
    std::vector<PointResult> find(std::span<const double> wishes, int repeat);

    /// The cheapest alone, timed `repeat` times, and its index among the schemes; where no scheme
    /// reaches the wishes the nearest, with status failed.
    std::pair<std::size_t, PointResult> cheapest(std::span<const double> wishes, int repeat);

    /// A scheme of the scene is given up where it would cost so many times the cheapest.
    static constexpr double mostTimesTheLeast = 100;
    /// "3.2 times dearer".
    static std::string timesDearer(double times);

    int runs() const { return runs_; }
    double secondsSpent() const { return spent_; }
    bool isTimeUp() const { return spent_ >= seconds_; }

private:
    struct Known {
        PointResult result;
        double cost = 0;
    };
    using Key =
        std::tuple<std::size_t, int, int, int, int, double>;  ///< scheme, degree, nodes, cells, smaller, n
    static Key keyOf(const StudyPoint& point, double n) {
        const Reduction& r = point.reduction;
        return {point.scheme, r.degree, r.nodes, r.cells, r.smaller, n};
    }

    const ResolvedScheme& schemeOf(std::size_t index) const {
        return scene_.schemes[schemes_[index].point.scheme];
    }
    StudyPoint pointAt(const StudyPoint& own, const ResolvedScheme& scheme, double n) const;
    std::vector<std::size_t> orderOfTrials() const;
    CandidateRace raceFor(std::span<const double> wishes);
    RaceEntry entryFor(const StudyPoint& own, const ResolvedScheme& scheme);
    void findStart(const StudyPoint& own, const ResolvedScheme& scheme, RaceEntry& entry);
    RaceRun runOf(const StudyPoint& own, const ResolvedScheme& scheme, const RaceJob& job,
                  std::span<const double> wishes);
    PointResult runCases(const StudyPoint& own, const StudyPoint& at, int repeat, const CostLimit& limit,
                         std::span<const double> wishes);
    void drive(CandidateRace& race, double seconds, const std::function<RaceRun(const RaceJob&)>& run);
    double unknownsOf(const StudyPoint& own) const;
    double costOf(const StudyPoint& own, const PointResult& result) const;
    bool hasMesh(std::size_t index) const;
    double wantedOf(std::span<const double> wishes) const { return wishes.size() == 1 ? wishes[0] : 1; }
    void searchMeshes(const CandidateRace& race, std::span<const double> wishes, double seconds,
                      double longestFirst);
    double firstSeconds(std::size_t index, const MeshPair& pair);
    void beginMeshes();
    MeshRun meshRunOf(std::size_t index, const MeshPair& pair, double limit, std::span<const double> wishes);
    bool isConfirmed(std::size_t index, const MeshRun& best, std::span<const double> wishes);
    double leastCost(const CandidateRace& race, std::span<const double> wishes) const;
    std::string floorOfMesh(std::size_t index, std::span<const double> wishes) const;
    void explainMesh(std::size_t index, double least, std::span<const double> wishes,
                     PointResult& result) const;
    void takeMesh(std::size_t index, const CandidateRace& race, std::span<const double> wishes,
                  PointResult& result) const;
    PointResult fullResultOf(const CandidateRace& race, std::size_t index,
                             std::span<const double> wishes) const;
    struct Variant {
        Reduction reduction;
        double costShare = 1, stepShare = 1;  ///< of a step, and of the most steps that could be cheaper
    };
    void reduce(std::size_t index, std::span<const double> wishes, PointResult& result);
    void raceOfVariants(std::size_t index, const std::vector<Variant>& variants,
                        std::span<const double> wishes, PointResult& result);
    void loosen(std::size_t index, std::span<const double> wishes, PointResult& result);
    std::string structureWithout(std::size_t index, const PointResult& exact, const PointResult& loose) const;
    PointResult resultOf(const CandidateRace& race, std::size_t index, double least) const;
    const PointResult& knownAt(const StudyPoint& point, double n) const;
    std::string reasonOf(const CandidateRace& race, std::size_t index, const PointResult& nearest) const;
    bool isReduced(std::size_t index) const;
    void nameFloor(std::size_t index, PointResult& result) const;
    std::vector<TriedRun> triedBy(std::size_t index) const;
    void time(std::vector<PointResult>& results, int repeat);
    void timeOne(std::size_t index, PointResult& result, int repeat);
    double excessOf(const PointResult& result, std::span<const double> wishes) const;
    bool isSaturated(const PointResult& result) const;
    double floorOf(std::size_t metric) const { return metrics_[metric].floorBy(reference_.estimatedError); }

    const ResolvedScene& scene_;
    std::vector<SearchedScheme> schemes_;
    std::vector<Metric> metrics_;
    References references_;
    ReferenceInfo reference_;
    std::vector<SearchCase> cases_;  ///< empty: the scene; else the hardest first
    bool isMedian_ = false;
    bool isCounted_;
    double seconds_, spent_ = 0, length_;
    std::stop_token stop_;
    ProcessorWatch watch_;
    int runs_ = 0;
    std::vector<std::optional<RaceEntry>> entries_;  ///< with where each begins, once it is known
    static constexpr double longestStep = 20;        ///< CPU seconds of a run that is counted and not timed
    static constexpr double trialLengths[] = {6, 24, 96, 384, 1536};  ///< of the whole motion, steps
    int useless_[std::size(trialLengths)] = {};  ///< schemes in a row that have no solution there
    std::map<Key, Known> known_;
    SearchKnobs knobs_;
    double mostBytes_ = std::numeric_limits<double>::infinity();
    std::map<std::size_t, MeshFit> meshes_;          ///< by scheme
    std::map<std::size_t, double> firstSeconds_;     ///< of the first run of each, from a few steps of it
    std::map<std::size_t, double> confirmedMeshes_;  ///< steps that confirmed the best, of the last wish
};

}  // namespace extremal
