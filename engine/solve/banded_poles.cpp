// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/solve/banded_poles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "engine/core/algebra/complex_vectors.hpp"
#include "engine/solve/banded_factors.hpp"
#include "engine/solve/banded_kernel.hpp"

namespace extremal {
namespace {

using Complex = std::complex<double>;
using Complexes = std::vector<Complex>;

/// What is smaller than this, relative to the result, does not reach its last bit.
constexpr double negligible = 1e-18;

/// 1/z without the care for overflow that makes std::complex ten times slower: entries are below 1e100.
Complex inverse(Complex z) {
    const double scale = 1 / (z.real() * z.real() + z.imag() * z.imag());
    return {z.real() * scale, -z.imag() * scale};
}

/// Numbers in whole cache lines.
class Lines {
public:
    void resize(std::size_t n) {
        store_.assign(n + 8, 0);
        const auto address = reinterpret_cast<std::uintptr_t>(store_.data());
        data_ = store_.data() + (64 - address % 64) % 64 / sizeof(double);
    }
    double* data() const { return data_; }

private:
    std::vector<double> store_;
    double* data_ = nullptr;
};

}  // namespace

struct BandedPoles::Impl {
    int rows = 0, band = 0, poles = 0;
    int segments = 1, length = 0;  ///< rows that a lane goes through
    std::array<int, 2> start{}, from{},
        to{};  ///< of each segment: its first row; rows that it gives the result for
    int reach = 0;
    double sign = 1;
    BandedCalls calls{};
    BandedSweep sweep;
    Lines l, u, p, x, y, z, residues;
    Complexes residue;
    Complexes middle;  ///< per pole 2B x 2B, row after row
    /// Per pole, for the first `reach` rows of both ends: 2B numbers. Where there are corners one, in
    /// the order of places, and the other factor in there: r_j (1 + C P^T Z)^{-1} C, C = [0 down; up 0].
    Complexes correction;
    std::vector<std::array<Complex, 4>> corners;
    mutable Complexes ends;

    int lanes() const { return 2 * segments * poles; }
    int groups() const { return 2 * segments; }
    int lane(int segment, int end, int pole) const { return pole * groups() + 2 * segment + end; }
    /// FFT order of row r of an end.
    int place(int end, int r) const { return end == 0 ? rows + r : rows - 1 - r; }

    void set(const Lines& a, int row, int at, Complex value) const {
        const auto i = static_cast<std::size_t>(2 * row * lanes() + at);
        a.data()[i] = value.real();
        a.data()[i + static_cast<std::size_t>(lanes())] = value.imag();
    }
    Complex get(const Lines& a, int row, int at) const {
        const auto i = static_cast<std::size_t>(2 * row * lanes() + at);
        return {a.data()[i], a.data()[i + static_cast<std::size_t>(lanes())]};
    }

    double factorBound(const CyclicBand& Y, const Complexes& zeta, int r) const;
    void chooseSegments(const CyclicBand& Y, const Complexes& zeta);
    void allocate();
    bool factorOne(const CyclicBand& Y, const Complexes& zeta, Complex up, Complex down);
    bool correctOne(const CyclicBand& Y, const Complexes& zeta, Complex up, Complex down);
    void factorAny(const CyclicBand& Y, const Complexes& zeta, const Complexes& up, const Complexes& down);
    void solveMiddle() const;
    void correctCorners(Complex* v) const;
    void correctCornersOfOne(Complex* v) const;
};

/// A bound of the factors of row r, both ends and all poles, where the band is one entry wide; 1 where there
/// is none.
double BandedPoles::Impl::factorBound(const CyclicBand& Y, const Complexes& zeta, int r) const {
    double square = 1e300;
    for (int e = 0; e < 2; ++e)
        for (const Complex& pole : zeta)
            square = std::min(
                square, std::norm(pole + Complex(0, Y.diagonal[static_cast<std::size_t>(place(e, r))])));
    const double least = std::sqrt(square), off = std::abs(Y.offDiagonal[0]);
    return least > 2 * off ? off / (least - off) : 1.0;
}

/// Far from the middle wave numbers are large and factors small: a substitution forgets where it came from
/// within a few rows. Then each end is cut in two, and both halves go side by side, with as many rows in
/// common as it takes to forget.
void BandedPoles::Impl::chooseSegments(const CyclicBand& Y, const Complexes& zeta) {
    const auto one = [&] {
        segments = 1;
        length = rows;
        start = {0, 0};
        from = {0, 0};
        to = {rows, 0};
    };
    one();
    if (band != 1 || poles > 4 || rows < 32) return;
    const int cut = rows / 2;
    const auto factor = [&](int r) { return factorBound(Y, zeta, r); };
    for (int r = cut; r-- > 0;)  // it is largest near the middle
        if (factor(r) == 1) return;
    int before = 0, after = 0;
    for (double left = 1; left > negligible; left *= factor(cut - before))
        if (++before >= rows / 4) return;
    for (double left = 1; left > negligible; left *= factor(cut + after - 1))
        if (++after >= rows / 4) return;
    const int common = std::max(before, after);
    segments = 2;
    length = std::max(cut + common, rows - cut + common);
    start = {0, rows - length};
    from = {0, cut};
    to = {cut, rows};
}

void BandedPoles::Impl::allocate() {
    const auto size = static_cast<std::size_t>(2 * length * lanes());
    l.resize(size * static_cast<std::size_t>(band));
    u.resize(size * static_cast<std::size_t>(band));
    p.resize(size);
    y.resize(size);
    x.resize(static_cast<std::size_t>(2 * length * groups()));
    z.resize(static_cast<std::size_t>(2 * length * groups()));
    residues.resize(static_cast<std::size_t>(2 * lanes()));
    for (int at = 0; at < lanes(); ++at)
        set(residues, 0, at, residue[static_cast<std::size_t>(at / groups())]);
    ends.assign(static_cast<std::size_t>(2 * band), 0);
    calls = bandedCalls(groups(), poles);
    sweep = {length, band, x.data(), l.data(), u.data(), p.data(), residues.data(), y.data(), z.data()};
}

/// False where the middle or the corners need the complete way.
bool BandedPoles::Impl::factorOne(const CyclicBand& Y, const Complexes& zeta, Complex up, Complex down) {
    if (band != 1 || !correctOne(Y, zeta, up, down)) return false;
    const auto n = static_cast<std::size_t>(lanes());
    Lines d, zetas, below, above;
    d.resize(static_cast<std::size_t>(length) * n);
    for (Lines* lines : {&zetas, &below, &above}) lines->resize(2 * n);
    for (int segment = 0; segment < segments; ++segment)
        for (int e = 0; e < 2; ++e)
            for (int j = 0; j < poles; ++j) {
                const int at = lane(segment, e, j);
                set(zetas, 0, at, zeta[static_cast<std::size_t>(j)]);
                set(below, 0, at, e == 0 ? down : up);
                set(above, 0, at, e == 0 ? up : down);
                for (int i = 0; i < length; ++i)
                    d.data()[static_cast<std::size_t>(i) * n + static_cast<std::size_t>(at)] =
                        Y.diagonal[static_cast<std::size_t>(
                            place(e, start[static_cast<std::size_t>(segment)] + i))];
            }
    calls.factor({length, zetas.data(), d.data(), below.data(), above.data(), std::norm(Y.offDiagonal[0]),
                  l.data(), u.data(), p.data()});
    for (int j = 0; j < poles; ++j) {
        const Complex a = get(p, length - 1, lane(segments - 1, 0, j)),
                      b = get(p, length - 1, lane(segments - 1, 1, j));
        const Complex scale = 1.0 / (1.0 - a * b * up * down);
        middle.insert(middle.end(), {scale * a, -scale * a * b * up, -scale * a * b * down, scale * b});
    }
    return true;
}

/// Column q of Z is (1/pivot, ..) from the corner inwards, which dies out with the factors.
bool BandedPoles::Impl::correctOne(const CyclicBand& Y, const Complexes& zeta, Complex up, Complex down) {
    const Complex loop = up * down;  // -|y|^2
    const double square = -loop.real();
    std::vector<std::array<Complexes, 2>> columns(zeta.size());
    int rowsUsed = 1;
    for (double left = 1; left > negligible && rowsUsed < rows / 2; ++rowsUsed) {
        const double bound = factorBound(Y, zeta, rowsUsed);
        if (bound == 1) break;
        left *= bound;
    }
    rowsUsed = std::max(rowsUsed, 12);
    for (bool isEnough = false; !isEnough; rowsUsed *= 2) {
        if (rowsUsed > rows / 2) return false;
        for (auto& both : columns)
            for (Complexes& g : both) g.resize(static_cast<std::size_t>(rowsUsed));
        // Every row waits for the one before: poles and ends side by side.
        Complex inner[8] = {};
        for (int r = rowsUsed - 1; r >= 0; --r)
            for (std::size_t c = 0; c < 2 * zeta.size(); ++c) {
                const double Yr = Y.diagonal[static_cast<std::size_t>(place(static_cast<int>(c % 2), r))];
                const Complex d = zeta[c / 2];
                inner[c] = columns[c / 2][c % 2][static_cast<std::size_t>(r)] =
                    inverse({d.real() + square * inner[c].real(), d.imag() + Yr + square * inner[c].imag()});
            }
        isEnough = true;
        for (auto& both : columns)
            for (int e = 0; e < 2; ++e) {
                Complexes& g = both[static_cast<std::size_t>(e)];
                const Complex below = e == 0 ? down : up;
                for (std::size_t r = 1; r < g.size(); ++r) g[r] *= -below * g[r - 1];
                isEnough = isEnough && std::norm(g.back()) <= negligible * negligible * std::norm(g[0]);
            }
    }
    double scale = 0;
    for (std::size_t j = 0; j < zeta.size(); ++j)
        scale = std::max(scale, std::abs(residue[j]) / std::abs(zeta[j]));
    reach = 0;
    for (std::size_t j = 0; j < zeta.size(); ++j) {
        const Complex a = columns[j][0][0], b = columns[j][1][0], s = residue[j] / (1.0 - a * b * loop);
        corners.push_back({-s * b * loop, s * down, s * up, -s * a * loop});
        for (std::size_t e = 0; e < 2; ++e) {
            const double most = std::max(std::norm(corners[j][2 * e]), std::norm(corners[j][2 * e + 1]));
            const double least = negligible * negligible * scale * scale;
            const Complexes& g = columns[j][e];
            for (std::size_t r = static_cast<std::size_t>(reach); r < g.size(); ++r)
                if (std::norm(g[r]) * most > least) reach = static_cast<int>(r) + 1;
        }
    }
    for (const auto& both : columns) {
        correction.insert(correction.end(), both[0].begin(), both[0].begin() + reach);
        correction.insert(correction.end(), both[1].rend() - reach, both[1].rend());
    }
    return true;
}

void BandedPoles::Impl::factorAny(const CyclicBand& Y, const Complexes& zeta, const Complexes& up,
                                  const Complexes& down) {
    std::vector<BandedFactors::Matrix> corrections;
    double scale = 0;
    reach = 0;
    correction.clear();
    corners.clear();
    middle.clear();
    for (std::size_t j = 0; j < zeta.size(); ++j) {
        Complexes diagonal;
        for (int a = 0; a < 2 * rows; ++a)
            diagonal.push_back(zeta[j] +
                               Complex(0, Y.diagonal[static_cast<std::size_t>((a + rows) % (2 * rows))]));
        const BandedFactors f(diagonal, up, down);
        for (int e = 0; e < 2; ++e)
            for (int r = 0; r < rows; ++r) {
                const int at = lane(0, e, static_cast<int>(j));
                for (int d = 0; d < band; ++d) {
                    set(l, r * band + d, at, f.lower[e](d, r));
                    set(u, r * band + d, at, f.upper[e](d, r));
                }
                set(p, r, at, f.pivot[e](r));
            }
        for (int i = 0; i < 2 * band; ++i)
            for (int k = 0; k < 2 * band; ++k) middle.push_back(f.middle(i, k));
        corrections.push_back(residue[j] * f.cornerCorrection(up, down));
        scale = std::max(scale, std::abs(residue[j]) / std::abs(zeta[j]));
    }
    for (const auto& M : corrections)
        for (int e = 0; e < 2; ++e)
            for (int r = reach; r < rows; ++r)
                if (M.row(e * rows + r).cwiseAbs().maxCoeff() > negligible * scale) reach = r + 1;
    for (const auto& M : corrections)
        for (int e = 0; e < 2; ++e)
            for (int r = 0; r < reach; ++r)
                for (int q = 0; q < 2 * band; ++q) correction.push_back(M(e * rows + r, q));
}

BandedPoles::BandedPoles(const CyclicBand& Y, const Complexes& zeta, const Complexes& residue, double sign)
    : impl_(std::make_unique<Impl>()) {
    Impl& m = *impl_;
    m.rows = static_cast<int>(Y.diagonal.size() / 2);
    m.band = static_cast<int>(Y.offDiagonal.size());
    m.poles = static_cast<int>(zeta.size());
    m.sign = sign;
    m.residue = residue;
    Complexes up, down;  // entries (a, a + m) and (a + m, a)
    for (const Complex& y : Y.offDiagonal) {
        up.push_back(Complex(0, 1) * std::conj(y));
        down.push_back(Complex(0, 1) * y);
    }
    m.chooseSegments(Y, zeta);
    m.allocate();
    if (m.factorOne(Y, zeta, up[0], down[0])) return;
    m.segments = 1;
    m.length = m.rows;
    m.start = m.from = {0, 0};
    m.to = {m.rows, 0};
    m.allocate();
    m.factorAny(Y, zeta, up, down);
}

BandedPoles::~BandedPoles() = default;
BandedPoles::BandedPoles(BandedPoles&&) noexcept = default;
BandedPoles& BandedPoles::operator=(BandedPoles&&) noexcept = default;

namespace {

/// Both ends of a segment into x: a is the first row of end 0, b that of end 1, which goes the other way.
template <int K>
void spread(const double* a, const double* b, int length, double* x) {
    for (int r = 0; r < length; ++r, a += 2, b -= 2, x += 2 * K) {
        x[0] = a[0];
        x[1] = b[0];
        x[K] = a[1];
        x[K + 1] = b[1];
    }
}

/// v <- sign v + z for the rows of both ends of a segment.
template <int K>
void gather(double* a, double* b, int length, const double* z, double sign) {
    for (int r = 0; r < length; ++r, a += 2, b -= 2, z += 2 * K) {
        a[0] = sign * a[0] + z[0];
        a[1] = sign * a[1] + z[1];
        b[0] = sign * b[0] + z[2];
        b[1] = sign * b[1] + z[3];
    }
}

}  // namespace

void BandedPoles::Impl::solveMiddle() const {
    const int size = 2 * band;
    for (int j = 0; j < poles; ++j) {
        const Complex* inverse = middle.data() + static_cast<std::size_t>(j * size * size);
        const auto rowOf = [&](int q) { return length - band + q % band; };
        const auto laneOf = [&](int q) { return lane(segments - 1, q / band, j); };
        for (int q = 0; q < size; ++q) ends[static_cast<std::size_t>(q)] = get(y, rowOf(q), laneOf(q));
        for (int i = 0; i < size; ++i) {
            Complex sum = 0;
            for (int q = 0; q < size; ++q) sum += inverse[i * size + q] * ends[static_cast<std::size_t>(q)];
            set(y, rowOf(i), laneOf(i), sum);
        }
        // A segment that does not meet the other end stops where it stands: what follows is forgotten on the
        // way back.
        for (int e = 0; e < 2 && segments == 2; ++e) {
            const int at = lane(0, e, j);
            set(y, length - 1, at, get(p, length - 1, at) * get(y, length - 1, at));
        }
    }
}

void BandedPoles::Impl::correctCorners(Complex* v) const {
    const auto size = static_cast<std::size_t>(2 * band);
    const Complex* M = correction.data();
    for (int j = 0; j < poles && reach > 0; ++j) {
        for (int q = 0; q < 2 * band; ++q)
            ends[static_cast<std::size_t>(q)] = get(y, q % band, lane(0, q / band, j));
        for (int e = 0; e < 2; ++e)
            for (int r = 0; r < reach; ++r, M += size) {
                double re = 0, im = 0;
                for (std::size_t q = 0; q < size; ++q) {
                    re += M[q].real() * ends[q].real() - M[q].imag() * ends[q].imag();
                    im += M[q].real() * ends[q].imag() + M[q].imag() * ends[q].real();
                }
                v[place(e, r)] -= Complex(re, im);
            }
    }
}

/// A band of one entry: what both ends give a column is one number.
void BandedPoles::Impl::correctCornersOfOne(Complex* v) const {
    const auto add = ComplexVectors::ofThisMachine().add;
    const auto count = static_cast<std::size_t>(reach);
    const Complex* column = correction.data();
    for (int j = 0; j < poles; ++j) {
        const Complex first = get(y, 0, lane(0, 0, j)), second = get(y, 0, lane(0, 1, j));
        const std::array<Complex, 4>& m = corners[static_cast<std::size_t>(j)];
        for (std::size_t e = 0; e < 2; ++e, column += count)
            add(v + (e == 0 ? rows : rows - reach), -(m[2 * e] * first + m[2 * e + 1] * second), column,
                count);
    }
}

void BandedPoles::apply(Complex* v) const {
    const Impl& m = *impl_;
    double* values = reinterpret_cast<double*>(v);
    for (int s = 0; s < m.segments; ++s) {
        const int r = m.start[static_cast<std::size_t>(s)];
        const auto call = m.segments == 1 ? &spread<2> : &spread<4>;
        call(values + 2 * m.place(0, r), values + 2 * m.place(1, r), m.length, m.x.data() + 2 * s);
    }
    m.calls.forward(m.sweep);
    m.solveMiddle();
    m.calls.backward(m.sweep);
    for (int s = 0; s < m.segments; ++s) {
        const auto i = static_cast<std::size_t>(s);
        const int r = m.from[i];
        const auto call = m.segments == 1 ? &gather<2> : &gather<4>;
        call(values + 2 * m.place(0, r), values + 2 * m.place(1, r), m.to[i] - r,
             m.z.data() + 2 * m.groups() * (r - m.start[i]) + 4 * s, m.sign);
    }
    if (m.corners.empty())
        m.correctCorners(v);
    else
        m.correctCornersOfOne(v);
}

}  // namespace extremal
