# embed.cmake - writes text files into one C table, name and text.
# cmake -DROOT=dir -DFILES="a;b" -DHEADER=device/kernel_table.h -DTABLE=pel_kernel -DOUT=table.c -P embed.cmake
# The header declares struct TABLE_file {name, text} and TABLE_table.
set(table "// Made from the files below ${ROOT} by cmake/embed.cmake.\n#include \"${HEADER}\"\n\n")
set(rows "")
set(index 0)
foreach(file IN LISTS FILES)
    file(READ ${ROOT}/${file} bytes HEX)
    string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
    string(APPEND table "static const char text_${index}[] = {${bytes}0};\n")
    string(APPEND rows "    {\"${file}\", text_${index}},\n")
    math(EXPR index "${index} + 1")
endforeach()
string(APPEND table "\nconst struct ${TABLE}_file ${TABLE}_table[] = {\n${rows}    {0, 0},\n};\n")
file(WRITE ${OUT} "${table}")
