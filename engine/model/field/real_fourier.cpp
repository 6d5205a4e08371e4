// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/field/real_fourier.hpp"

#include <fftw3.h>

#include <map>
#include <mutex>
#include <tuple>
#include <vector>

namespace extremal {

struct RealFourier::Plans {
    fftw_plan forward = nullptr, backward = nullptr;

    Plans(int nx, int ny, TransformPlanning planning) {
        std::vector<double> u(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny));
        std::vector<std::complex<double>> c(static_cast<std::size_t>(nx / 2 + 1) *
                                            static_cast<std::size_t>(ny));
        auto* const modes = reinterpret_cast<fftw_complex*>(c.data());
        const int sizes[] = {ny, nx}, rank = ny > 1 ? 2 : 1, *const n = sizes + 2 - rank;
        const auto make = [&](unsigned how) {
            forward = fftw_plan_dft_r2c(rank, n, u.data(), modes, how | FFTW_PRESERVE_INPUT);
            backward = fftw_plan_dft_c2r(rank, n, modes, u.data(), how);
        };
        if (planning == TransformPlanning::measured) make(FFTW_MEASURE);
        if (planning == TransformPlanning::wise) make(FFTW_MEASURE | FFTW_WISDOM_ONLY);
        if (forward && backward) return;
        destroy();
        make(FFTW_ESTIMATE);
    }
    ~Plans() { destroy(); }
    Plans(const Plans&) = delete;
    Plans& operator=(const Plans&) = delete;

    /// The planner is not thread-safe, executing is.
    static std::shared_ptr<const Plans> of(int nx, int ny, TransformPlanning planning) {
        static std::mutex mutex;
        static std::map<std::tuple<int, int, TransformPlanning>, std::shared_ptr<const Plans>> known;
        const std::lock_guard lock(mutex);
        auto& plans = known[{nx, ny, planning}];
        if (!plans) plans = std::make_shared<const Plans>(nx, ny, planning);
        return plans;
    }

private:
    void destroy() {
        for (const fftw_plan plan : {forward, backward})
            if (plan) fftw_destroy_plan(plan);
    }
};

RealFourier::RealFourier(int nx, int ny, TransformPlanning planning)
    : nx_(nx), ny_(ny), plans_(Plans::of(nx, ny, planning)) {}

void RealFourier::toModes(const double* u, std::complex<double>* c) const {
    // FFTW takes its input without const; PRESERVE_INPUT keeps the promise.
    fftw_execute_dft_r2c(plans_->forward, const_cast<double*>(u), reinterpret_cast<fftw_complex*>(c));
}

void RealFourier::toNodes(std::complex<double>* c, double* u) const {
    fftw_execute_dft_c2r(plans_->backward, reinterpret_cast<fftw_complex*>(c), u);
}

}  // namespace extremal
