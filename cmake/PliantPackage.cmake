# What is installed and the Debian package of it: `./dev package` leaves build/package/*.deb.
include(GNUInstallDirs)

set(programs pliant-cli)
if(PLIANT_BUILD_UI)
  list(APPEND programs pliant)
endif()
foreach(program ${programs})
  if(TARGET ${program})
    install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  endif()
endforeach()

set(data ${CMAKE_INSTALL_DATADIR}/pliant)
install(DIRECTORY scenes DESTINATION ${data})
install(FILES resources/pliant-scene.schema.json DESTINATION ${data}/resources)
install(PROGRAMS resources/pliant-shards.sbatch DESTINATION ${data}/resources)

set(id org.pliant.Pliant)
install(FILES resources/desktop/${id}.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
install(FILES resources/desktop/${id}.metainfo.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo)
install(FILES resources/desktop/${id}.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
install(FILES resources/desktop/${id}.mime.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages RENAME ${id}.xml)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)

# Debian wants man pages and the changelog compressed, without the time of the compression in them.
foreach(page resources/man/pliant.1 resources/man/pliant-cli.1 CHANGELOG.md)
  cmake_path(GET page FILENAME name)
  string(REPLACE "CHANGELOG.md" "changelog" name ${name})
  set(compressed ${PROJECT_BINARY_DIR}/compressed/${name}.gz)
  add_custom_command(OUTPUT ${compressed} DEPENDS ${PROJECT_SOURCE_DIR}/${page} VERBATIM
                     COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/compressed
                     COMMAND gzip -9n < ${PROJECT_SOURCE_DIR}/${page} > ${compressed})
  list(APPEND compressed_pages ${compressed})
  if(name MATCHES "changelog")
    install(FILES ${compressed} DESTINATION ${CMAKE_INSTALL_DOCDIR})
  else()
    install(FILES ${compressed} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  endif()
endforeach()
add_custom_target(compressed_pages ALL DEPENDS ${compressed_pages})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME pliant)
set(CPACK_PACKAGE_CONTACT "The Pliant developers <developers@pliant.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "design nonlinear mechanical systems by their motion")
set(CPACK_PACKAGE_DESCRIPTION "Computes the steady motion of springs, masses and thin shells under a periodic drive, shows it
 next to its frequency-response curve, and predicts at once how it changes when a mass does.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR})
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# What shared-library analysis cannot see: the software renderer is loaded at run time, the fonts are files.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libosmesa6, fonts-dejavu-core")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libgl1-mesa-dri, qt6-wayland")
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
    WORLD_READ WORLD_EXECUTE)
include(CPack)
