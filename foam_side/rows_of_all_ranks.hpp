// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <vector>

#include "coupler/grid/bulk_cells.hpp"
#include "foam_side/openfoam.hpp"

namespace demvof {

/// Records (plain rows of doubles) of all ranks on every rank, in the same order. Collective.
template <class Record>
std::vector<Record> on_every_rank(const std::vector<Record>& mine) {
  constexpr int width = row_width<Record>();
  Foam::List<Foam::scalarList> rows(Foam::Pstream::nProcs());
  Foam::scalarList& own = rows[Foam::Pstream::myProcNo()];
  own.setSize(static_cast<Foam::label>(mine.size()) * width);
  std::copy_n(reinterpret_cast<const double*>(mine.data()), own.size(), own.begin());
  Foam::Pstream::gatherList(rows);
  Foam::Pstream::scatterList(rows);
  std::vector<Record> all;
  for (const Foam::scalarList& part : rows) {
    const std::size_t first = all.size();
    all.resize(first + part.size() / width);
    std::copy(part.begin(), part.end(), reinterpret_cast<double*>(all.data() + first));
  }
  return all;
}

}  // namespace demvof
