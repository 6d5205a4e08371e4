// SPDX-License-Identifier: GPL-3.0-or-later
/// Wave functions that vanish at both ends of an interval, by their coordinates c in the polynomials of
/// wave/interval.hpp, which get the length of the domain here. Immutable.
#pragma once

#include <Eigen/Core>

#include <memory>
#include <utility>
#include <vector>

#include "engine/model/wave/basis/fourier.hpp"
#include "engine/model/wave/basis/interval.hpp"
#include "engine/model/wave/means.hpp"

namespace extremal {

class DirichletBasis {
public:
    DirichletBasis(const wave::Domain& domain, int n, double hbar, double mass);

    int size() const { return interval_->size(); }
    const Interval& interval() const { return *interval_; }
    /// The inner nodes.
    const std::vector<double>& x() const { return x_; }
    /// One place, at 0 (wave/grid.hpp).
    const std::vector<double>& y() const { return y_; }
    /// The points of the rule, at which the potential counts; point 2j + 2 is node j.
    std::vector<double> points() const;

    void toNodes(const Complex* c, Complex* psi) const;
    void toCoefficients(const Complex* psi, Complex* c) const;
    /// H is real in c itself.
    void toReal(const Complex* c, Complex* v) const;
    void fromReal(Complex* v, Complex* c) const;
    /// H in these coordinates, from the values of V at the points.
    Eigen::MatrixXd matrix(const Eigen::VectorXd& V) const;

    /// Coefficient k of psi as a series of Chebyshev polynomials, k = 0 .. size() + 1.
    Complex chebyshevCoefficient(const Complex* c, int k) const;
    /// Values at the middles of `rows` equal cells from those at the nodes: (row, node).
    Eigen::MatrixXd resampling(int rows) const;

    /// Squares of the Chebyshev coefficients in the upper eighth of the degrees, and of all.
    std::pair<double, double> tail(const Complex* c) const;
    MeanMomentum momentum(const Complex* c) const;
    NodeMeans means(const Complex* c, Complex* work) const;
    double currentInTheMiddle(const Complex* c, Complex* work, Complex* slope) const;

private:
    wave::Domain domain_;
    double hbar_, mass_;
    std::shared_ptr<const Interval> interval_;
    std::vector<double> x_, y_{0};
};

}  // namespace extremal
