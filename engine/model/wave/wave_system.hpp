// SPDX-License-Identifier: GPL-3.0-or-later
/// What systems of wave functions share, whatever the shape of their domain: the System of an operator, how
/// it is drawn, and the keys of a start.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/model/system.hpp"
#include "engine/model/wave/hamiltonian.hpp"

namespace extremal {

/// The state is the coefficients of the wave function (wave/hamiltonian.hpp): no column of a row, but what
/// fields are sampled from. `make` is called once for the same settings as long as they are among the last
/// few asked for: on a large grid the potential alone takes a tenth of a second. Any thread may ask.
System makeWaveSystem(const Settings& settings,
                      const std::function<std::shared_ptr<const Hamiltonian>(const Settings&)>& make);

/// hbar and m.
std::vector<FieldInfo> waveConstants();
wave::Constants constantsOf(const Settings& settings);
/// The ends of an axis: `key` is domain or domain_y. Throws InvalidScene.
wave::Domain domainOf(const Settings& settings, const std::string& key);
/// The number of modes of an axis, `key` is modes or modes_y; refuses odd ones where it must be even.
int modesOf(const Settings& settings, const std::string& key, bool isEven);
FieldInfo domainField(const std::string& key, const std::string& title, const std::string& description);

/// The key interaction.
FieldInfo interactionField();

/// The keys psi and normalise; `places` are the names in expressions: "x", "x and y".
std::vector<FieldInfo> waveStartFields(const std::string& places);

/// The state as shapes, from values at the nodes (FieldSampling).
void drawWave(const Hamiltonian& h, const double* values, Drawing& drawing);

}  // namespace extremal
