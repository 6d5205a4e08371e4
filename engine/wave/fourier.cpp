#include "engine/wave/fourier.hpp"

#include <fftw3.h>

#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <vector>

namespace extremal {

struct Fourier::Plans {
    fftw_plan forward = nullptr, backward = nullptr;

    explicit Plans(int n) {
        std::vector<Complex> a(static_cast<std::size_t>(n)), b(a);
        const auto raw = [](std::vector<Complex>& v) { return reinterpret_cast<fftw_complex*>(v.data()); };
        const unsigned flags = FFTW_ESTIMATE | FFTW_PRESERVE_INPUT;
        forward = fftw_plan_dft_1d(n, raw(a), raw(b), FFTW_FORWARD, flags);
        backward = fftw_plan_dft_1d(n, raw(a), raw(b), FFTW_BACKWARD, flags);
    }
    ~Plans() {
        fftw_destroy_plan(forward);
        fftw_destroy_plan(backward);
    }
    Plans(const Plans&) = delete;
    Plans& operator=(const Plans&) = delete;

    /// The planner is not thread-safe, executing is.
    static std::shared_ptr<const Plans> of(int n) {
        static std::mutex mutex;
        static std::map<int, std::shared_ptr<const Plans>> known;
        const std::lock_guard lock(mutex);
        auto& plans = known[n];
        if (!plans) plans = std::make_shared<const Plans>(n);
        return plans;
    }
};

namespace {

void execute(fftw_plan plan, const Complex* from, Complex* to) {
    // FFTW takes its input without const; PRESERVE_INPUT keeps the promise.
    fftw_execute_dft(plan, reinterpret_cast<fftw_complex*>(const_cast<Complex*>(from)),
                     reinterpret_cast<fftw_complex*>(to));
}

void scale(Complex* v, int n, double factor) {
    double* values = reinterpret_cast<double*>(v);
    for (int i = 0; i < 2 * n; ++i) values[i] *= factor;
}

}  // namespace

Fourier::Fourier(int n, double length) : n_(n), length_(length), plans_(Plans::of(n)) {}

double Fourier::waveNumber(int i) const { return 2 * std::numbers::pi * number(i) / length_; }

void Fourier::rawToNodes(const Complex* c, Complex* psi) const { execute(plans_->backward, c, psi); }

void Fourier::rawToCoefficients(const Complex* psi, Complex* c) const { execute(plans_->forward, psi, c); }

void Fourier::toNodes(const Complex* c, Complex* psi) const {
    rawToNodes(c, psi);
    scale(psi, n_, 1 / std::sqrt(length_));
}

void Fourier::toCoefficients(const Complex* psi, Complex* c) const {
    rawToCoefficients(psi, c);
    scale(c, n_, std::sqrt(length_) / n_);
}

}  // namespace extremal
