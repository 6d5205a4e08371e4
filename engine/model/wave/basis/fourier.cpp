// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/basis/fourier.hpp"

#include <fftw3.h>

#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <tuple>
#include <vector>

namespace extremal {

namespace {

/// FFTW's planner is not thread-safe, executing is.
std::mutex& planner() {
    static std::mutex mutex;
    return mutex;
}

fftw_complex* raw(const Complex* v) {
    // FFTW takes its input without const; PRESERVE_INPUT keeps the promise.
    return reinterpret_cast<fftw_complex*>(const_cast<Complex*>(v));
}

/// One direction of the transform.
///
/// A large rectangle whose plan is estimated is transformed row by row, then a few columns at a time through
/// a buffer: such a plan for the whole goes down columns whose entries all fall into the same lines of the
/// cache, and takes 2.5 times as long at 256 x 256.
class Direction {
public:
    Direction(int nx, int ny, int sign, Fourier::Planning planning)
        : nx_(nx), ny_(ny), together_(nx % 8 == 0 ? 8 : 2) {
        std::vector<Complex> a(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny)), b(a);
        const auto whole = [&](unsigned how) {
            const unsigned flags = how | FFTW_PRESERVE_INPUT;
            return ny > 1 ? fftw_plan_dft_2d(ny, nx, raw(a.data()), raw(b.data()), sign, flags)
                          : fftw_plan_dft_1d(nx, raw(a.data()), raw(b.data()), sign, flags);
        };
        if (planning == Fourier::Planning::measured) first_ = whole(FFTW_MEASURE);
        if (planning == Fourier::Planning::wise) first_ = whole(FFTW_MEASURE | FFTW_WISDOM_ONLY);
        if (first_) return;
        if (ny == 1 || nx * ny < 1 << 15) {
            first_ = whole(FFTW_ESTIMATE);
            return;
        }
        first_ = fftw_plan_many_dft(1, &nx, ny, raw(a.data()), nullptr, 1, nx, raw(b.data()), nullptr, 1, nx,
                                    sign, FFTW_ESTIMATE | FFTW_PRESERVE_INPUT);
        columns_ = fftw_plan_many_dft(1, &ny, together_, raw(a.data()), nullptr, 1, ny, raw(a.data()),
                                      nullptr, 1, ny, sign, FFTW_ESTIMATE);
    }
    ~Direction() {
        fftw_destroy_plan(first_);
        if (columns_) fftw_destroy_plan(columns_);
    }
    Direction(const Direction&) = delete;
    Direction& operator=(const Direction&) = delete;

    void execute(const Complex* from, Complex* to) const {
        fftw_execute_dft(first_, raw(from), raw(to));
        if (!columns_) return;
        static thread_local std::vector<Complex> buffer;
        buffer.resize(static_cast<std::size_t>(together_) * static_cast<std::size_t>(ny_));
        for (int x = 0; x < nx_; x += together_) {
            for (int y = 0; y < ny_; ++y)
                for (int i = 0; i < together_; ++i) buffer[at(i, y)] = to[x + i + y * nx_];
            fftw_execute_dft(columns_, raw(buffer.data()), raw(buffer.data()));
            for (int y = 0; y < ny_; ++y)
                for (int i = 0; i < together_; ++i) to[x + i + y * nx_] = buffer[at(i, y)];
        }
    }

private:
    std::size_t at(int i, int y) const { return static_cast<std::size_t>(i * ny_ + y); }

    int nx_, ny_, together_;
    fftw_plan first_ = nullptr, columns_ = nullptr;
};

}  // namespace

struct Fourier::Plans {
    Direction forward, backward;

    Plans(int nx, int ny, Planning planning)
        : forward(nx, ny, FFTW_FORWARD, planning), backward(nx, ny, FFTW_BACKWARD, planning) {}

    static std::shared_ptr<const Plans> of(int nx, int ny, Planning planning) {
        static std::map<std::tuple<int, int, Planning>, std::shared_ptr<const Plans>> known;
        const std::lock_guard lock(planner());
        auto& plans = known[{nx, ny, planning}];
        if (!plans) plans = std::make_shared<const Plans>(nx, ny, planning);
        return plans;
    }
};

namespace {

void scale(Complex* v, int n, double factor) {
    double* values = reinterpret_cast<double*>(v);
    for (int i = 0; i < 2 * n; ++i) values[i] *= factor;
}

}  // namespace

Fourier::Fourier(const wave::Grid& grid, Planning planning)
    : grid_(grid), plans_(Plans::of(grid.nx, grid.ny, planning)) {}

double Fourier::waveNumber(int i) const { return 2 * std::numbers::pi * number(i) / grid_.x.length; }
double Fourier::waveNumberY(int i) const { return 2 * std::numbers::pi * numberY(i) / grid_.y.length; }

void Fourier::rawToNodes(const Complex* c, Complex* psi) const { plans_->backward.execute(c, psi); }

void Fourier::rawToCoefficients(const Complex* psi, Complex* c) const { plans_->forward.execute(psi, c); }

void Fourier::toNodes(const Complex* c, Complex* psi) const {
    rawToNodes(c, psi);
    scale(psi, size(), 1 / std::sqrt(grid_.measure()));
}

void Fourier::toCoefficients(const Complex* psi, Complex* c) const {
    rawToCoefficients(psi, c);
    scale(c, size(), std::sqrt(grid_.measure()) / size());
}

struct AxisTransforms::Plans {
    fftw_plan nodesX, nodesY, numbersX, numbersY;

    Plans(int nx, int ny) {
        const std::lock_guard lock(planner());
        std::vector<Complex> v(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny));
        const auto along = [&](bool isX, int sign) {
            const int n = isX ? nx : ny, apart = isX ? 1 : nx, next = isX ? nx : 1;
            return fftw_plan_many_dft(1, &n, isX ? ny : nx, raw(v.data()), nullptr, apart, next,
                                      raw(v.data()), nullptr, apart, next, sign, FFTW_ESTIMATE);
        };
        nodesX = along(true, FFTW_BACKWARD);
        nodesY = along(false, FFTW_BACKWARD);
        numbersX = along(true, FFTW_FORWARD);
        numbersY = along(false, FFTW_FORWARD);
    }
    ~Plans() {
        const std::lock_guard lock(planner());
        for (const fftw_plan plan : {nodesX, nodesY, numbersX, numbersY}) fftw_destroy_plan(plan);
    }
    Plans(const Plans&) = delete;
    Plans& operator=(const Plans&) = delete;
};

AxisTransforms::AxisTransforms(const wave::Grid& grid)
    : plans_(std::make_shared<const Plans>(grid.nx, grid.ny)) {}

void AxisTransforms::toNodesAlongX(Complex* v) const { fftw_execute_dft(plans_->nodesX, raw(v), raw(v)); }
void AxisTransforms::toNodesAlongY(Complex* v) const { fftw_execute_dft(plans_->nodesY, raw(v), raw(v)); }
void AxisTransforms::toNumbersAlongX(Complex* v) const { fftw_execute_dft(plans_->numbersX, raw(v), raw(v)); }
void AxisTransforms::toNumbersAlongY(Complex* v) const { fftw_execute_dft(plans_->numbersY, raw(v), raw(v)); }

}  // namespace extremal
