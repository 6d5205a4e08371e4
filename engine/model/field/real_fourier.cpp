// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/field/real_fourier.hpp"

#include <fftw3.h>

#include <map>
#include <mutex>
#include <utility>
#include <vector>

namespace extremal {

struct RealFourier::Plans {
    fftw_plan forward, backward;

    Plans(int nx, int ny) {
        std::vector<double> u(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny));
        std::vector<std::complex<double>> c(static_cast<std::size_t>(nx / 2 + 1) *
                                            static_cast<std::size_t>(ny));
        auto* const modes = reinterpret_cast<fftw_complex*>(c.data());
        const int sizes[] = {ny, nx}, rank = ny > 1 ? 2 : 1, *const n = sizes + 2 - rank;
        forward = fftw_plan_dft_r2c(rank, n, u.data(), modes, FFTW_ESTIMATE | FFTW_PRESERVE_INPUT);
        backward = fftw_plan_dft_c2r(rank, n, modes, u.data(), FFTW_ESTIMATE);
    }
    ~Plans() {
        fftw_destroy_plan(forward);
        fftw_destroy_plan(backward);
    }
    Plans(const Plans&) = delete;
    Plans& operator=(const Plans&) = delete;

    /// The planner is not thread-safe, executing is.
    static std::shared_ptr<const Plans> of(int nx, int ny) {
        static std::mutex mutex;
        static std::map<std::pair<int, int>, std::shared_ptr<const Plans>> known;
        const std::lock_guard lock(mutex);
        auto& plans = known[{nx, ny}];
        if (!plans) plans = std::make_shared<const Plans>(nx, ny);
        return plans;
    }
};

RealFourier::RealFourier(int nx, int ny) : nx_(nx), ny_(ny), plans_(Plans::of(nx, ny)) {}

void RealFourier::toModes(const double* u, std::complex<double>* c) const {
    // FFTW takes its input without const; PRESERVE_INPUT keeps the promise.
    fftw_execute_dft_r2c(plans_->forward, const_cast<double*>(u), reinterpret_cast<fftw_complex*>(c));
}

void RealFourier::toNodes(std::complex<double>* c, double* u) const {
    fftw_execute_dft_c2r(plans_->backward, reinterpret_cast<fftw_complex*>(c), u);
}

}  // namespace extremal
