# embed.cmake - writes the kernel files into one C table, name and text.
# cmake -DROOT=dir -DFILES="a;b" -DOUT=table.c -P embed.cmake
set(table "// Made from the files below kernels/ by cmake/embed.cmake.\n#include \"device/kernel_table.h\"\n\n")
set(rows "")
set(index 0)
foreach(file IN LISTS FILES)
    file(READ ${ROOT}/${file} bytes HEX)
    string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
    string(APPEND table "static const char text_${index}[] = {${bytes}0};\n")
    string(APPEND rows "    {\"${file}\", text_${index}},\n")
    math(EXPR index "${index} + 1")
endforeach()
string(APPEND table "\nconst struct pel_kernel_file pel_kernel_table[] = {\n${rows}    {0, 0},\n};\n")
file(WRITE ${OUT} "${table}")
