// SPDX-License-Identifier: GPL-3.0-or-later
/// How the functions of expressions are written: their names, and how many arguments they take. Internal to
/// core/expression*.
#pragma once

#include <string>
#include <string_view>

namespace extremal {

struct Signature {
    std::string_view name;
    std::string_view meaning;  ///< the function it is; "^": the operator
    int least, most;           ///< arguments
    bool isReserved = false;   ///< cannot be the name of anything else
    bool isFolded = false;     ///< f(a, b, c) = f(f(a, b), c)
    bool isChain = false;      ///< conditions and values, and a last value
    bool isTable = false;      ///< an argument, then points after semicolons

    /// "one argument", "at least two arguments".
    std::string counted() const;
};

/// Null: no function has this name.
const Signature* findSignature(std::string_view name);

}  // namespace extremal
