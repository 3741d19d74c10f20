# Writes a source file that holds every template below FOLDER as a raw string literal.
set(entries "")
foreach(path IN LISTS TEMPLATES)
    file(RELATIVE_PATH name ${FOLDER} ${path})
    string(REPLACE ".mustache" "" name ${name})
    file(READ ${path} content)
    string(APPEND entries "    {\"${name}\", R\"template(${content})template\"},\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"deck/templates.hpp\"

namespace vibrotrough::deck {

core::TemplateTexts const input_templates{
${entries}};

}  // namespace vibrotrough::deck
")
