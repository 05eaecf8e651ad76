# One CMake target a folder. `pliant_add_library(core/mechanics DEPENDS core/geometry ...)` compiles the
# folder's *.cpp files into the static library `pliant_core_mechanics`. A folder can include only what it
# links, and it links only folders below itself, so the link graph enforces the include rule.

find_program(PLIANT_CCACHE ccache)
if(PLIANT_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # With the base folder two checkouts share what they have in common; the compiler itself lists the headers used.
  set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_DEPEND=1 CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}
      CCACHE_SLOPPINESS=include_file_mtime,include_file_ctime ${PLIANT_CCACHE})
endif()

add_library(pliant_options INTERFACE)
target_include_directories(pliant_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_definitions(pliant_options INTERFACE PLIANT_VERSION="${PROJECT_VERSION}")
target_compile_options(pliant_options INTERFACE -ffp-contract=fast)
if(PLIANT_NATIVE)
  target_compile_options(pliant_options INTERFACE -march=native)
endif()
if(PLIANT_SANITIZE)
  target_compile_options(pliant_options INTERFACE -fsanitize=${PLIANT_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(pliant_options INTERFACE -fsanitize=${PLIANT_SANITIZE})
endif()

# For the targets that read scenes/ or resources/ at run time.
add_library(pliant_data_dir INTERFACE)
target_compile_definitions(pliant_data_dir INTERFACE PLIANT_DATA_DIR="${PLIANT_DATA_DIR}")

# Linked last and privately, so that warnings concern our own files alone. -Wrestrict is wrong about std::string's
# operator+ in GCC 12 (GCC bug 105651), and warnings of uninitialized variables are wrong about its AVX-512 intrinsics (GCC
# bug 105593): code for any processor, as of the preset `strict`, has none of these.
add_library(pliant_warnings INTERFACE)
target_compile_options(pliant_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
                       -Woverloaded-virtual -Wcast-align -Wunused -Wnull-dereference -Wno-psabi -Wno-restrict
                       $<$<BOOL:${PLIANT_NATIVE}>:-Wno-uninitialized -Wno-maybe-uninitialized>
                       $<$<BOOL:${PLIANT_WARNINGS_AS_ERRORS}>:-Werror>)

function(pliant_target_name out folder)
  string(REPLACE "/" "_" name ${folder})
  set(${out} pliant_${name} PARENT_SCOPE)
endfunction()

# pliant_add_library(FOLDER [DEPENDS FOLDER...] [LIBRARIES TARGET...] [PRIVATE_LIBRARIES TARGET...] [QT])
function(pliant_add_library folder)
  cmake_parse_arguments(ARG "QT" "" "DEPENDS;LIBRARIES;PRIVATE_LIBRARIES" ${ARGN})
  pliant_target_name(target ${folder})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.cpp ${PROJECT_SOURCE_DIR}/${folder}/*.hpp)
  add_library(${target} STATIC ${sources})  # header-only folders are fine
  set_target_properties(${target} PROPERTIES LINKER_LANGUAGE CXX)
  if(ARG_QT)
    set_target_properties(${target} PROPERTIES AUTOMOC ON AUTORCC ON)
    target_compile_definitions(${target} PRIVATE QT_NO_KEYWORDS)  # `slots` is a name in core; write Q_SLOTS
  endif()
  set(dependencies)
  foreach(dependency ${ARG_DEPENDS})
    pliant_target_name(name ${dependency})
    list(APPEND dependencies ${name})
  endforeach()
  target_link_libraries(${target} PUBLIC pliant_options ${dependencies} ${ARG_LIBRARIES}
                        PRIVATE ${ARG_PRIVATE_LIBRARIES} pliant_warnings)
endfunction()

# pliant_add_executable(NAME FOLDER [DEPENDS FOLDER...] [LIBRARIES TARGET...] [QT]) builds NAME into the preset's own
# bin folder. build/bin/NAME is a link to that of the preset built last: were it the program itself, the other presets
# would take it for their own and leave it.
function(pliant_add_executable target folder)
  cmake_parse_arguments(ARG "QT" "" "DEPENDS;LIBRARIES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.cpp ${PROJECT_SOURCE_DIR}/${folder}/*.hpp)
  add_executable(${target} ${sources})
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
  set(link ${PROJECT_SOURCE_DIR}/build/bin/${target})
  add_custom_target(${target}.link COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_SOURCE_DIR}/build/bin
                    COMMAND ${CMAKE_COMMAND} -E create_symlink ${PROJECT_BINARY_DIR}/bin/${target} ${link}
                    COMMENT "Linking build/bin/${target}" VERBATIM)
  add_dependencies(${target} ${target}.link)
  if(ARG_QT)
    set_target_properties(${target} PROPERTIES AUTOMOC ON AUTORCC ON)
    target_compile_definitions(${target} PRIVATE QT_NO_KEYWORDS)  # `slots` is a name in core; write Q_SLOTS
  endif()
  set(dependencies)
  foreach(dependency ${ARG_DEPENDS})
    pliant_target_name(name ${dependency})
    list(APPEND dependencies ${name})
  endforeach()
  target_link_libraries(${target} PRIVATE ${dependencies} ${ARG_LIBRARIES} pliant_options pliant_warnings)
endfunction()

# pliant_add_test(FILE LABEL core|scenes|ui|screenshots|long... [DEPENDS FOLDER...] [LIBRARIES TARGET...]
#                 [PARTS NAME...] [LONG])
# compiles the Qt Test FILE.cpp (relative to the calling folder) into one test program. With PARTS it runs once for each,
# which stands in the environment variable PLIANT_TEST_PART. LONG ones begin first, so that none is left running alone.
function(pliant_add_test file)
  cmake_parse_arguments(ARG "LONG" "" "LABEL;DEPENDS;LIBRARIES;PARTS" ${ARGN})
  file(RELATIVE_PATH place ${PROJECT_SOURCE_DIR}/tests ${CMAKE_CURRENT_SOURCE_DIR}/${file})
  string(REPLACE "/" "." name ${place})
  set(target test.${name})
  add_executable(${target} ${file}.cpp)
  set_target_properties(${target} PROPERTIES AUTOMOC ON RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests/bin)
  set(dependencies)
  foreach(dependency ${ARG_DEPENDS})
    pliant_target_name(dependency_target ${dependency})
    list(APPEND dependencies ${dependency_target})
  endforeach()
  target_compile_definitions(${target} PRIVATE PLIANT_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  if("${ARG_DEPENDS}" MATCHES "ui/|app/")
    target_compile_definitions(${target} PRIVATE QT_NO_KEYWORDS)
  endif()
  target_link_libraries(${target} PRIVATE ${dependencies} ${ARG_LIBRARIES} Qt6::Test pliant_options pliant_warnings)
  set(environment
      QT_QPA_PLATFORM=offscreen
      GALLIUM_DRIVER=llvmpipe
      OPENBLAS_NUM_THREADS=1
      LC_ALL=C.UTF-8
      LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/leaks_of_libraries.txt
      TSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/races_of_libraries.txt)
  if(NOT ARG_PARTS)
    set(ARG_PARTS all)
  endif()
  foreach(part ${ARG_PARTS})
    set(test ${name})
    if(NOT part STREQUAL all)
      string(APPEND test .${part})
    endif()
    add_test(NAME ${test} COMMAND ${target})
    set_tests_properties(${test} PROPERTIES LABELS "${ARG_LABEL}" ENVIRONMENT "${environment};PLIANT_TEST_PART=${part}")
    if(ARG_LONG)
      set_tests_properties(${test} PROPERTIES COST 1000)
    endif()
  endforeach()
endfunction()
