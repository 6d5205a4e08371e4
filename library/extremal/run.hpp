// SPDX-License-Identifier: GPL-3.0-or-later
/// Running a scene: every enabled scheme is a task on a pool of threads; partial results can be read while it
/// goes on.
///
///     const Comparison result = run(scene);                        // wait for everything
///     Run r(scene); r.start(); ... r.latest(); r.stop();           // or watch it
///
/// The cpu_seconds of a result are those of this one run; a Study measures costs by repetitions.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/value.hpp"
#include "extremal/scene.hpp"

namespace extremal::api {

/// The samples of a field or wave function: value (frame, component c, place i) at frame.values[c * places +
/// i]; x holds the places (in the plane, all x of the first y, then of the second; `rows` is their number).
struct Frame {
    double t = 0;
    std::span<const double> x, values;
};

/// What one scheme of a comparison gave. Spans are valid as long as any copy of it lives.
class EXTREMAL_API SchemeResult {
public:
    const std::string& label() const;
    /// "done", "partial" (stopped), "failed"; "waiting" and "running" while the run goes on.
    std::string status() const;
    /// Why it failed: "diverged", "singular", ...; else empty.
    std::string cause() const;
    /// The row of summary.json: label, status, cause, steps, cpu_seconds, max_energy_error, ...
    Value summary() const;
    /// "t", the state ("q.x", "p.x", ...), then what the scene observes ("energy_error", ...).
    const std::vector<std::string>& columns() const;
    /// The values of a column, one per row. Throws std::out_of_range, naming the columns there are.
    std::span<const double> operator[](std::string_view column) const;
    /// Its unit; empty if it has none.
    const std::string& unit(std::string_view column) const;
    std::size_t rows() const;
    /// Of fields and wave functions: "u", "u_t" or "re", "im"; else empty.
    std::vector<std::string> components() const;
    std::size_t frames() const;
    Frame frame(std::size_t index) const;

    struct Data;
    explicit SchemeResult(std::shared_ptr<const Data> data);

private:
    std::shared_ptr<const Data> data_;
};

class EXTREMAL_API Comparison {
public:
    std::size_t size() const;
    /// The enabled schemes, in the order of the scene.
    SchemeResult operator[](std::size_t scheme) const;
    /// By its label. Throws std::out_of_range, naming the labels there are.
    SchemeResult operator[](std::string_view label) const;
    bool isFinished() const;
    /// The document of summary.json.
    Value summary() const;
    /// Writes what `extremal run` does; the folder is made if missing. Returns the names of the files. Throws
    /// std::runtime_error where the files cannot be written, or would replace one that no run has written;
    /// then none is left half-written.
    std::vector<std::string> write(const std::string& folder) const;

    struct Data;
    explicit Comparison(std::shared_ptr<const Data> data);
    const Data& data() const { return *data_; }  ///< for the library itself

private:
    std::shared_ptr<const Data> data_;
};

class EXTREMAL_API Run {
public:
    /// `threads`: 0 for as many as the machine has cores.
    explicit Run(const Scene& scene, unsigned threads = 0);
    ~Run();  ///< stops and waits
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;

    void start();
    void stop();  ///< returns at once; what is finished is kept
    void wait();
    bool isFinished() const;
    double fraction() const;    ///< of the whole work, 0 to 1
    Comparison latest() const;  ///< what there is so far

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

/// Called with the fraction of the work that is done some thirty times a second, by the thread that waits;
/// false stops the work.
using Progress = std::function<bool(double fraction)>;

/// Runs everything and returns it; partial results if it was stopped.
EXTREMAL_API Comparison run(const Scene& scene, unsigned threads = 0, const Progress& progress = {});

/// Where the motions of one scheme from many starts end.
struct Motions {
    std::vector<std::string> columns;  ///< of a state: "q.x", "p.x", ...
    /// The last state of each, motion after motion.
    std::vector<double> states;
    /// Why a motion has not reached the end ("not-finite", "lost", "stopped", ...); else empty.
    std::vector<std::string> causes;
    std::vector<long long> steps;
    std::vector<double> t;            ///< of the last state
    std::vector<double> energyError;  ///< H there less H at the start; NaN where there is none
    std::size_t together = 0;         ///< so many were computed in the lanes of vector instructions
};

/// From each of these states, of as many numbers as the state has columns, one after the other. `scheme`: a
/// label; empty: the first enabled one. Each motion has the bits that it has by itself. Events of the scene
/// are not looked for. Throws InvalidScene for a label that no scheme has, or starts that are none.
EXTREMAL_API Motions runMany(const Scene& scene, std::span<const double> starts, std::string_view scheme = {},
                             unsigned threads = 0, const Progress& progress = {});

}  // namespace extremal::api
