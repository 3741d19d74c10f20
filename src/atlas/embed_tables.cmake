# Writes a source file that holds the tables of the atlas as raw string literals.
file(READ ${FOLDER}/layers.csv layers)
file(READ ${FOLDER}/draws.csv draws)
file(WRITE ${OUTPUT} "#include \"atlas/tables.hpp\"

namespace vibrotrough::atlas {

std::string_view const layers_table = R\"table(${layers})table\";
std::string_view const draws_table = R\"table(${draws})table\";

}  // namespace vibrotrough::atlas
")
