// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "coupler/config/parameters.hpp"

// How the case file spells the choices of parameters.hpp.

namespace demvof {

template <class E>
using EnumNames = std::vector<std::pair<E, std::string>>;

template <class E>
inline const EnumNames<E> enum_names;

template <>
inline const EnumNames<Schedule> enum_names<Schedule> = {{Schedule::staggered, "staggered"},
                                                         {Schedule::concurrent, "concurrent"}};
template <>
inline const EnumNames<ExchangeScheme> enum_names<ExchangeScheme> = {
    {ExchangeScheme::explicit_drag, "explicit"},
    {ExchangeScheme::semi_implicit, "semi_implicit"},
    {ExchangeScheme::conservative_implicit, "conservative_implicit"}};
template <>
inline const EnumNames<Kernel> enum_names<Kernel> = {{Kernel::centre, "centre"},
                                                     {Kernel::volume, "volume"},
                                                     {Kernel::linear, "linear"},
                                                     {Kernel::gaussian, "gaussian"},
                                                     {Kernel::diffusion, "diffusion"}};
template <>
inline const EnumNames<Mapping> enum_names<Mapping> = {{Mapping::nearest, "nearest"},
                                                       {Mapping::inverse_distance, "inverse_distance"},
                                                       {Mapping::cell_point, "cell_point"},
                                                       {Mapping::cell_point_face, "cell_point_face"},
                                                       {Mapping::conservative, "conservative"}};
template <>
inline const EnumNames<Sharing> enum_names<Sharing> = {{Sharing::volume, "volume"}, {Sharing::mass, "mass"}};
template <>
inline const EnumNames<PhaseInterchange> enum_names<PhaseInterchange> = {
    {PhaseInterchange::porous, "porous"},
    {PhaseInterchange::volume_adding, "volume_adding"},
    {PhaseInterchange::replacement, "replacement"},
    {PhaseInterchange::none, "none"}};
template <>
inline const EnumNames<DragLaw> enum_names<DragLaw> = {{DragLaw::none, "none"},
                                                       {DragLaw::schiller_naumann, "schiller_naumann"},
                                                       {DragLaw::gidaspow, "gidaspow"},
                                                       {DragLaw::di_felice, "di_felice"},
                                                       {DragLaw::koch_hill, "koch_hill"},
                                                       {DragLaw::beetstra, "beetstra"},
                                                       {DragLaw::rong, "rong"}};
template <>
inline const EnumNames<OwnWake> enum_names<OwnWake> = {{OwnWake::none, "none"}, {OwnWake::oseen, "oseen"}};
template <>
inline const EnumNames<SpinLiftLaw> enum_names<SpinLiftLaw> = {
    {SpinLiftLaw::none, "none"},
    {SpinLiftLaw::rubinow_keller, "rubinow_keller"},
    {SpinLiftLaw::oesterle_bui_dinh, "oesterle_bui_dinh"}};
template <>
inline const EnumNames<SuspensionViscosity> enum_names<SuspensionViscosity> = {
    {SuspensionViscosity::none, "none"},
    {SuspensionViscosity::krieger_dougherty, "krieger_dougherty"},
    {SuspensionViscosity::eilers, "eilers"}};
template <>
inline const EnumNames<LiftLaw> enum_names<LiftLaw> = {{LiftLaw::none, "none"},
                                                       {LiftLaw::saffman_mei, "saffman_mei"}};
template <>
inline const EnumNames<Switch> enum_names<Switch> = {
    {Switch::automatic, "auto"}, {Switch::on, "on"}, {Switch::off, "off"}};

/// The case file's word for a choice.
template <class E>
const std::string& name_of(E choice) {
  for (const auto& [value, name] : enum_names<E>)
    if (value == choice) return name;
  throw std::logic_error("a choice without a name");
}

}  // namespace demvof
