// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/basis/wisdom.hpp"

#include <fftw3.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <stdexcept>

#include "engine/core/text/regular_file.hpp"
#include "engine/model/field/real_fourier.hpp"
#include "engine/model/wave/basis/fourier.hpp"

namespace extremal {
namespace {

/// Microseconds of a transform there and back: the best of some tenths of a second.
template <class ThereAndBack>
double bestOf(ThereAndBack&& once) {
    using Time = std::chrono::steady_clock;
    double best = 1e300;
    const auto start = Time::now();
    do {
        const auto before = Time::now();
        constexpr int repeats = 8;
        for (int i = 0; i < repeats; ++i) once();
        best =
            std::min(best, std::chrono::duration<double, std::micro>(Time::now() - before).count() / repeats);
    } while (Time::now() - start < std::chrono::milliseconds(200));
    return best;
}
double microsecondsOf(const Fourier& fourier) {
    const std::vector<Complex> from(static_cast<std::size_t>(fourier.size()), Complex(1));
    std::vector<Complex> to(from), back(from);
    return bestOf([&] {
        fourier.rawToNodes(from.data(), to.data());
        fourier.rawToCoefficients(to.data(), back.data());
    });
}
double microsecondsOf(const RealFourier& fourier) {
    const std::vector<double> from(static_cast<std::size_t>(fourier.size()), 1.0);
    std::vector<Complex> modes(static_cast<std::size_t>(fourier.modes()));
    std::vector<double> back(from);
    return bestOf([&] {
        fourier.toModes(from.data(), modes.data());
        fourier.toNodes(modes.data(), back.data());
    });
}

}  // namespace

void useWisdom(const std::string& file) {
    std::string text;
    try {
        text = readRegularFile(file);
    } catch (const UnreadableFile& e) {
        throw std::runtime_error("\"" + file + "\" " + e.what());
    }
    if (fftw_import_wisdom_from_string(text.c_str()) == 0)
        throw std::runtime_error("\"" + file + "\" does not hold wisdom of this FFTW");
}

TransformGain measureTransform(const TransformSize& size) {
    const wave::Grid grid{{0, 1}, size.nx, {0, 1}, size.ny};
    TransformGain gain;
    gain.estimated = microsecondsOf(Fourier(grid, Fourier::Planning::estimated));
    gain.measured = microsecondsOf(Fourier(grid, Fourier::Planning::measured));
    gain.realEstimated = microsecondsOf(RealFourier(size.nx, size.ny, TransformPlanning::estimated));
    gain.realMeasured = microsecondsOf(RealFourier(size.nx, size.ny, TransformPlanning::measured));
    return gain;
}

std::string wisdom() {
    const std::unique_ptr<char, void (*)(char*)> text(fftw_export_wisdom_to_string(),
                                                      [](char* s) { fftw_free(s); });
    return text ? std::string(text.get()) : std::string();
}

}  // namespace extremal
