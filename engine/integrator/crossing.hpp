// SPDX-License-Identifier: GPL-3.0-or-later
/// Where a function g of the state passes zero inside a step, on the dense output of the scheme.
///
/// g is sampled in the step until its samples are those of a smooth curve: where a parabola through every
/// other sample misses those in between by more than a share of the range, there are twice as many, up to
/// `mostParts`; where the dense output oscillates by itself, 16 per period to begin with. So it does not
/// matter how a scheme makes its dense output, and g may bend more than that does. An extremum of the samples
/// that could reach zero is looked for, as two zeros may be behind it; around a zero that is found, one of
/// g/(tau - zero). A place is found to round-off of tau.
///
/// Not zeros: poles (1/x), cuts (atan2(y, x)) and jumps (sign(x)), where |g| does not shrink on either side.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "engine/integrator/integrator.hpp"

namespace extremal {

struct Crossing {
    double tau;  ///< in (0, 1]
    bool isUpwards;
};

/// The dense output of one step, of which every function in it needs the same places.
class StepSamples {
public:
    /// A new step: `size` entries of the state are read. What was returned before is no longer valid.
    void begin(const Integrator& integrator, std::size_t size);
    const double* at(double tau);
    /// Places that every function is sampled at, without 0 and 1.
    const std::vector<double>& places() const { return places_; }

private:
    const Integrator* integrator_ = nullptr;
    std::vector<double> places_;
    std::vector<char> isKnown_;
    std::vector<std::vector<double>> known_;
    std::vector<double> other_;
};

/// What rounding makes of numbers of the size of these.
double roundingOf(std::span<const double> values);

/// Finds the zeros of functions, step after step; its buffers are kept.
class CrossingFinder {
public:
    struct Function {
        const void* of;
        double (*call)(const void*, double);
        double operator()(double tau) const { return call(of, tau); }
    };
    /// Refers to the value, which has to stay.
    template <class Value>
    static Function functionOf(const Value& value) {
        return {&value, [](const void* of, double tau) { return (*static_cast<const Value*>(of))(tau); }};
    }
    struct Sample {
        double tau, value;
    };

    static constexpr std::size_t mostParts = 512;

    /// The zeros of value(tau) in the order of their places, given the values at the nodes. A zero at the
    /// later node belongs to the step, one at the earlier node to the step before. A function that varies by
    /// no more than `noise`, what rounding makes of it, is not resolved any further.
    template <class Value>
    const std::vector<Crossing>& find(double first, double last, const std::vector<double>& places,
                                      const Value& value, double noise = 0) {
        noise_ = noise;
        search(first, last, places, functionOf(value));
        return found_;
    }

private:
    using Samples = std::vector<Sample>;
    void search(double first, double last, const std::vector<double>& places, const Function& g);
    void refine(const Function& g);
    bool isResolved();
    double misfit(std::size_t i) const;
    void lookForExtrema(const Function& g);
    void addZeros(const Function& g, const Sample& a, const Sample& b, int depth);
    void addHiddenZeros(const Function& g, const Sample& a, const Sample& b, double zero, int depth);

    Samples samples_, finer_, extrema_;
    std::vector<Crossing> found_;
    double range_ = 0, noise_ = 0;  ///< of the samples
};

}  // namespace extremal
