// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/libraries.hpp"

#include <Eigen/Core>

#include <boost/version.hpp>
#include <fftw3.h>
#include <ginac/version.h>
#include <nlohmann/json.hpp>
#ifdef EXTREMAL_HAS_GSL
#include <gsl/gsl_version.h>
#endif
#ifdef EXTREMAL_HAS_SUNDIALS
#include <sundials/sundials_config.h>
#endif
#ifdef EXTREMAL_HAS_XBYAK
#include <xbyak/xbyak.h>
#endif

namespace extremal {
namespace {

std::string joined(int a, int b, int c) {
    return std::to_string(a) + "." + std::to_string(b) + "." + std::to_string(c);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> libraries() {
    std::string gsl = "not built in", sundials = gsl, xbyak = gsl;
#ifdef EXTREMAL_HAS_GSL
    gsl = GSL_VERSION;
#endif
#ifdef EXTREMAL_HAS_SUNDIALS
    sundials = SUNDIALS_VERSION;
#endif
#ifdef EXTREMAL_HAS_XBYAK
    // 0xABCD is A.BC.D.
    xbyak = joined(Xbyak::VERSION >> 12, 10 * (Xbyak::VERSION >> 8 & 15) + (Xbyak::VERSION >> 4 & 15),
                   Xbyak::VERSION & 15);
#endif
    return {{"Eigen", joined(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
            {"Boost", joined(BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100)},
            {"FFTW", fftw_version},
            {"GiNaC", joined(GINACLIB_MAJOR_VERSION, GINACLIB_MINOR_VERSION, GINACLIB_MICRO_VERSION)},
            {"nlohmann-json",
             joined(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
            {"GSL", gsl},
            {"SUNDIALS", sundials},
            {"Xbyak", xbyak}};
}

}  // namespace extremal
