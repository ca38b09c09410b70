// "contacts", "frets" and "neck" of a string -> one list of contacts, in that order.
#pragma once

#include <vector>

#include "formats/json/object_reader.h"
#include "formats/scene/scene.h"
#include "jawari/scene/description.h"

namespace jawari::host {

std::vector<ContactDescription> read_all_contacts(json::ObjectReader& string, double length_m,
                                                  ContactSources& sources);

}  // namespace jawari::host
