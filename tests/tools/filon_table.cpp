// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/tools/filon_table.hpp"

#include <boost/multiprecision/float128.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "engine/quadrature/rule.hpp"

namespace extremal::tools {
namespace {

using Quad = boost::multiprecision::float128;

/// A complex number of quadruple precision: std::complex is for the built-in types.
struct QuadComplex {
    Quad re = 0, im = 0;
};
QuadComplex operator+(QuadComplex a, QuadComplex b) { return {a.re + b.re, a.im + b.im}; }
QuadComplex operator*(Quad s, QuadComplex a) { return {s * a.re, s * a.im}; }
Quad distance(QuadComplex a, QuadComplex b) {
    const Quad re = a.re - b.re, im = a.im - b.im;
    return sqrt(re * re + im * im);
}

/// int_0^1 x^j e^{izx} dx, j < count.
std::vector<QuadComplex> moments(Quad z, int count) {
    std::vector<QuadComplex> mu;
    for (int j = 0; j < count; ++j) {
        QuadComplex m;
        if (z < 8) {
            Quad term = 1;
            for (int n = 0; n < 80; ++n) {
                const Quad share = term / (n + j + 1);
                (n % 2 == 0 ? m.re : m.im) += n % 4 < 2 ? share : -share;
                term *= z / (n + 1);
            }
        } else {  // (e^{iz} - j mu_{j-1}) / (iz); e^{iz} - 1 for j = 0
            QuadComplex top{cos(z), sin(z)};
            if (j == 0)
                top.re -= 1;
            else
                top = top + Quad(-j) * mu.back();
            m = {top.im / z, -top.re / z};
        }
        mu.push_back(m);
    }
    return mu;
}

/// The integrals of the cardinal polynomials of the nodes times e^{izx}.
std::vector<QuadComplex> cardinalWeights(const std::vector<Quad>& node, Quad z) {
    const auto mu = moments(z, static_cast<int>(node.size()));
    std::vector<QuadComplex> weights;
    for (std::size_t i = 0; i < node.size(); ++i) {
        std::vector<Quad> c{1};
        for (std::size_t k = 0; k < node.size(); ++k) {
            if (k == i) continue;
            const Quad scale = 1 / (node[i] - node[k]);
            c.emplace_back(0);
            for (std::size_t n = c.size(); n-- > 0;)
                c[n] = scale * ((n > 0 ? c[n - 1] : Quad(0)) - (n + 1 < c.size() ? c[n] * node[k] : Quad(0)));
        }
        QuadComplex sum;
        for (std::size_t n = 0; n < c.size(); ++n) sum = sum + c[n] * mu[n];
        weights.push_back(sum);
    }
    return weights;
}

std::vector<Quad> wideNodes(FilonNodes nodes, int count) {
    return nodes == FilonNodes::gauss ? gauss<Quad>(count).c : lobatto<Quad>(count).c;
}

/// int_0^1 e^{hx} e^{izx} dx = (e^s - 1)/s, s = h + iz.
QuadComplex exactIntegral(Quad h, Quad z) {
    const Quad e = exp(h), re = e * cos(z) - 1, im = e * sin(z), size = h * h + z * z;
    return {(re * h + im * z) / size, (im * h - re * z) / size};
}

double slope(double large, double small, double ratio) { return std::log(large / small) / std::log(ratio); }

}  // namespace

double filonError(FilonNodes nodes, int count, double h, double z) {
    const FilonRule rule = filonRule(nodes, count, z);
    std::complex<double> sum = 0;
    for (std::size_t i = 0; i < rule.node.size(); ++i) sum += rule.weight[i] * std::exp(h * rule.node[i]);
    return h * static_cast<double>(distance({sum.real(), sum.imag()}, exactIntegral(h, z)));
}

double wideFilonError(FilonNodes nodes, int count, double h, double z) {
    const std::vector<Quad> node = wideNodes(nodes, count);
    const std::vector<QuadComplex> weight = cardinalWeights(node, z);
    QuadComplex sum;
    for (std::size_t i = 0; i < node.size(); ++i) sum = sum + exp(h * node[i]) * weight[i];
    return static_cast<double>(h * distance(sum, exactIntegral(h, z)));
}

double filonWeightError(FilonNodes nodes, int count, double z) {
    const FilonRule rule = filonRule(nodes, count, z);
    const std::vector<QuadComplex> weight = cardinalWeights(wideNodes(nodes, count), z);
    double worst = 0;
    for (std::size_t i = 0; i < weight.size(); ++i)
        worst = std::max(
            worst, static_cast<double>(distance({rule.weight[i].real(), rule.weight[i].imag()}, weight[i])));
    return worst;
}

FilonSlopes measureSlopes(FilonNodes nodes, int count) {
    constexpr double h = 1.0 / 32;  // smaller ones sink into the round-off of quadruple precision at order 11
    const auto inStep = [&](double z) {
        return slope(wideFilonError(nodes, count, 2 * h, z), wideFilonError(nodes, count, h, z), 2);
    };
    const auto overATurn = [&](double z) {
        constexpr int places = 64;
        double most = 0;
        for (int i = 0; i < places; ++i)
            most = std::max(most, wideFilonError(nodes, count, 1, z + 2 * std::numbers::pi * i / places));
        return most;
    };
    return {inStep(1e-9), inStep(1), inStep(1000), -slope(overATurn(1e3), overATurn(1e5), 100)};
}

const std::vector<FilonColumn>& filonColumns() {
    static const std::vector<FilonColumn> all = [] {
        std::vector<FilonColumn> columns;
        for (const FilonNodes nodes : {FilonNodes::gauss, FilonNodes::lobatto})
            for (int count = 3; count <= 5; ++count)
                columns.push_back(
                    {nodes, count,
                     (nodes == FilonNodes::gauss ? "Gauss " : "Lobatto ") + std::to_string(count)});
        return columns;
    }();
    return all;
}

const std::vector<double>& filonRows() {
    static const std::vector<double> rows = {0.01, 0.1, 1, 10, 100, 1e3, 1e4, 1e5, 1e6};
    return rows;
}

}  // namespace extremal::tools
