# Writes a source file that holds the tables of the atlas as raw string literals.
foreach(table layers draws draws_law draws_added_mass draws_damping)
    file(READ ${FOLDER}/${table}.csv ${table})
endforeach()
file(WRITE ${OUTPUT} "#include \"atlas/tables.hpp\"

namespace vibrotrough::atlas {

std::string_view const layers_table = R\"table(${layers})table\";
std::string_view const draws_table = R\"table(${draws})table\";
std::string_view const law_draws_table = R\"table(${draws_law})table\";
std::string_view const added_mass_draws_table = R\"table(${draws_added_mass})table\";
std::string_view const damping_draws_table = R\"table(${draws_damping})table\";

}  // namespace vibrotrough::atlas
")
