// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/start/vortices.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"

namespace extremal {

VortexCount countVortices(const wave::Grid& grid, const Complex* psi) {
    constexpr double least = 1e-3;
    double most = 0;
    for (int j = 0; j < grid.size(); ++j) most = std::max(most, std::norm(psi[j]));
    VortexCount count;
    for (int y = 0; y + 1 < grid.ny; ++y)
        for (int x = 0; x + 1 < grid.nx; ++x) {
            const int at = x + y * grid.nx;
            const std::array<Complex, 4> corners{psi[at], psi[at + 1], psi[at + 1 + grid.nx],
                                                 psi[at + grid.nx]};
            double turn = 0, density = 0;
            for (std::size_t k = 0; k < 4; ++k) {
                turn += std::arg(corners[(k + 1) % 4] * std::conj(corners[k]));
                density = std::max(density, std::norm(corners[k]));
            }
            if (density < least * most) continue;
            const long turns = std::lround(turn / (2 * std::numbers::pi));
            if (turns > 0) ++count.positive;
            if (turns < 0) ++count.negative;
        }
    return count;
}

}  // namespace extremal

namespace extremal::wave {
namespace {

constexpr const char* packetName = "vortices";

struct Vortex {
    double x = 0, y = 0;
    int charge = 1;
};

std::vector<Vortex> placesOf(const Value& psi, const std::string& pointer, const Constants& constants) {
    const Value *const positions = psi.find("positions"), *const charges = psi.find("charges");
    const std::string place = pointer + "/positions";
    if (!positions || !positions->isArray() || positions->asArray().empty())
        throw InvalidScene(place, "must be a list of places", "[[1, 0], [-1, 0]]");
    if (charges && (!charges->isArray() || charges->asArray().size() != positions->asArray().size()))
        throw InvalidScene(pointer + "/charges", "must be a list with a number for each of the places",
                           "1 or -1 for each, or leave it out: 1 for all");
    std::vector<Vortex> all;
    for (std::size_t i = 0; i < positions->asArray().size(); ++i) {
        const Value& at = positions->asArray()[i];
        const std::string own = place + "/" + std::to_string(i);
        if (!at.isArray() || at.asArray().size() != 2)
            throw InvalidScene(own, "must be a place in the plane", "[1, 0]");
        Vortex v{numberIn(at.asArray()[0], own + "/0", constants),
                 numberIn(at.asArray()[1], own + "/1", constants), 1};
        if (charges) {
            const std::string of = pointer + "/charges/" + std::to_string(i);
            const double charge = numberIn(charges->asArray()[i], of, constants);
            if (charge != std::floor(charge) || charge == 0 || std::abs(charge) > 8)
                throw InvalidScene(
                    of, "must be a whole number from -8 to 8 and not 0, got " + formatNumber(charge),
                    "1 or -1");
            v.charge = static_cast<int>(charge);
        }
        all.push_back(v);
    }
    return all;
}

}  // namespace

CatalogItem vortexPacket() {
    const auto list = [](const char* key, const char* description, Value example) {
        FieldInfo f = jsonField(key, key, "", nullptr, description);
        f.example = std::move(example);
        return f;
    };
    FieldInfo width = numberField("width", "width", "", 0, "Of the cloud; a tenth of the domain by default.");
    width.fallback = nullptr;
    return {
        packetName,
        "vortices in a cloud",
        "exp(-r^2/(4 width^2)) times (x - x_i +- i (y - y_i))/sqrt(|r - r_i|^2 + core^2) for each vortex.",
        {list("positions", "Places of the vortices: [[x, y], ..].", Value::Array{Value::Array{1.0, 0.0}}),
         list("charges", "How often the phase turns around each, and to which side; 1 by default.",
              Value::Array{1.0}),
         width, positive("core", "core", "", 1, "Radius of the hole around a vortex.")},
        {},
        "a wave function in the plane"};
}

std::vector<Complex> vorticesOf(const Value& psi, const std::string& pointer, const Hamiltonian& h,
                                const Constants& constants) {
    if (h.dimension() != 2)
        throw InvalidScene(pointer + "/packet", "vortices are for the plane",
                           "the model schrodinger-2d, or another packet");
    const Grid& grid = h.grid();
    const auto p = parametersOf(
        psi, pointer,
        {{"width", std::min(grid.x.length, grid.y.length) / 10, false, true}, {"core", 1, false, true}},
        {"packet", "positions", "charges"}, constants);
    const std::vector<Vortex> vortices = placesOf(psi, pointer, constants);
    const double x0 = grid.x.left + grid.x.length / 2, y0 = grid.y.left + grid.y.length / 2;
    std::vector<Complex> values;
    for (const double y : h.y())
        for (const double x : h.x()) {
            Complex value = std::exp(-((x - x0) * (x - x0) + (y - y0) * (y - y0)) / (4 * p[0] * p[0]));
            for (const Vortex& v : vortices) {
                const double dx = x - v.x, dy = v.charge > 0 ? y - v.y : v.y - y;
                const Complex factor = Complex(dx, dy) / std::sqrt(dx * dx + dy * dy + p[1] * p[1]);
                for (int k = 0; k < std::abs(v.charge); ++k) value *= factor;
            }
            values.push_back(value);
        }
    return values;
}

}  // namespace extremal::wave
