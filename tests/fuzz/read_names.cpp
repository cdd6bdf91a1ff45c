// Fuzz target of the reader of names of openings.

#include <set>

#include "fuzz/fuzz_target.h"
#include "fuzz/memory_file.h"
#include "surface/names.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hexwall;
  const test::MemoryFile file(".json", {reinterpret_cast<const char*>(data), size});
  std::vector<NamedPlace> places;
  if (!test::succeeds([&] { places = read_names(file.path()); })) return 0;
  std::set<std::string> names;
  for (const NamedPlace& place : places) {
    test::require(is_valid_name(place.name), "a name is not valid");
    test::require(names.insert(place.name).second, "a name occurs twice");
    test::require(place.at.allFinite(), "a place is not finite");
  }
  return 0;
}
