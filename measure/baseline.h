// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// An earlier measurement of the same rail or wheel as the reference, so that what a new section has lost is
// wear and not the rolling tolerance (half a millimetre) of the new rail.
#pragma once

#include <string>
#include <vector>

#include "measure/register_section.h"

namespace lightstripe {

/// The nominal outline, moved along its normals to where the section was measured (medians within 1 mm), in
/// the nominal's frame. What the section does not show is carried over from its neighbours. `registration`:
/// of the section on the nominal, usable.
Outline outline_of_baseline(const Section& section, const ReferenceShape& nominal,
                            const Registration& registration);

/// The sections of an earlier scan as references, each at its travel.
class Baseline {
 public:
  /// Sections that cannot be laid on the nominal are left out. An Error where none is left.
  Baseline(const std::vector<Profile>& profiles, const ReferenceShape& nominal, const SectionPrior& prior,
           const RegistrationOptions& options, const std::string& source);

  /// The one nearest in travel; the only one whatever the travel. Nothing where the nearest is farther than
  /// twice the usual distance between neighbours.
  const ReferenceShape* at(double travel) const;
  std::size_t size() const { return places_.size(); }

 private:
  struct Place {
    double travel = 0;
    ReferenceShape shape;
  };
  std::vector<Place> places_;  // by travel
  double reach_ = 0;
};

}  // namespace lightstripe
