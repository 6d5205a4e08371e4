// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/field/spectral_grid.hpp"

#include <algorithm>
#include <complex>

namespace extremal {
namespace {

std::complex<double>* modesOfRow(double* row) { return reinterpret_cast<std::complex<double>*>(row); }

std::size_t product(int a, int b) { return static_cast<std::size_t>(a) * static_cast<std::size_t>(b); }

}  // namespace

SpectralGrid::SpectralGrid(int nx, int ny, int mx, int my)
    : nx_(nx),
      ny_(ny),
      mx_(mx),
      my_(my),
      nodes_(product(nx, ny)),
      points_(product(mx, my)),
      modes_(product(nx / 2 + 1, ny)),
      kept_(static_cast<std::size_t>((nx + 1) / 2)),
      hasPointsAtNodes_(mx == nx && my == ny),
      atNodes_(nx, ny),
      atPoints_(mx, my),
      values_(std::max(nodes_, points_)),
      spectrum_(2 * std::max(modes_, product(mx / 2 + 1, my))) {}

bool SpectralGrid::findRow(std::size_t l, std::size_t& atPoints) const {
    const std::size_t n = rows();
    if (n > 1 && 2 * l == n) return false;
    atPoints = 2 * l < n ? l : static_cast<std::size_t>(my_) - (n - l);
    return true;
}

void SpectralGrid::clearOutside(double* row) const {
    const std::size_t width = static_cast<std::size_t>(nx_ / 2 + 1);
    for (std::size_t l = 0, same = 0; l < rows(); ++l) {
        const std::size_t kept = findRow(l, same) ? kept_ : 0;
        std::fill(row + 2 * (l * width + kept), row + 2 * (l + 1) * width, 0.0);
    }
}

void SpectralGrid::toModes(const double* nodes, double* row) {
    const double scale = 1 / static_cast<double>(nodes_);
    for (std::size_t i = 0; i < nodes_; ++i) values_[i] = scale * nodes[i];  // and they are aligned
    atNodes_.toModes(values_.data(), modesOfRow(row));
}

void SpectralGrid::toNodes(const double* row, double* nodes) {
    std::copy_n(row, 2 * modes_, spectrum_.data());
    atNodes_.toNodes(modesOfRow(spectrum_.data()), values_.data());
    std::copy_n(values_.data(), nodes_, nodes);
}

void SpectralGrid::toPoints(const double* row, double* values) {
    const std::size_t width = static_cast<std::size_t>(nx_ / 2 + 1),
                      wide = static_cast<std::size_t>(mx_ / 2 + 1);
    if (hasPointsAtNodes_) {
        std::copy_n(row, 2 * modes_, spectrum_.data());
        clearOutside(spectrum_.data());
        atPoints_.toNodes(modesOfRow(spectrum_.data()), values);
        return;
    }
    std::fill(spectrum_.begin(), spectrum_.end(), 0.0);
    for (std::size_t l = 0, to = 0; l < rows(); ++l)
        if (findRow(l, to)) std::copy_n(row + 2 * l * width, 2 * kept_, spectrum_.data() + 2 * to * wide);
    atPoints_.toNodes(modesOfRow(spectrum_.data()), values);
}

void SpectralGrid::fromPoints(const double* values, double* row) {
    const std::size_t width = static_cast<std::size_t>(nx_ / 2 + 1),
                      wide = static_cast<std::size_t>(mx_ / 2 + 1);
    if (hasPointsAtNodes_) {
        atPoints_.toModes(values, modesOfRow(row));
        clearOutside(row);
        return;
    }
    atPoints_.toModes(values, modesOfRow(spectrum_.data()));
    for (std::size_t l = 0, from = 0; l < rows(); ++l)
        if (findRow(l, from)) std::copy_n(spectrum_.data() + 2 * from * wide, 2 * kept_, row + 2 * l * width);
    clearOutside(row);
}

double SpectralGrid::squareOf(const double* row) const {
    const std::size_t width = static_cast<std::size_t>(nx_ / 2 + 1);
    double all = 0, once = 0;
    for (std::size_t i = 0; i < 2 * modes_; ++i) all += row[i] * row[i];
    for (std::size_t l = 0; l < rows(); ++l) {
        const double re = row[2 * l * width], im = row[2 * l * width + 1];
        once += re * re + im * im;
    }
    return 2 * all - once;
}

}  // namespace extremal
