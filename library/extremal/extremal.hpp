// SPDX-License-Identifier: GPL-3.0-or-later
/// The whole library.
#pragma once

#include "extremal/answers.hpp"
#include "extremal/api.hpp"
#include "extremal/catalogue.hpp"
#include "extremal/figure.hpp"
#include "extremal/own.hpp"
#include "extremal/run.hpp"
#include "extremal/scene.hpp"
#include "extremal/study.hpp"
