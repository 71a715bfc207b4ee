<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="cs_CZ" sourcelanguage="en">
<context>
    <name>AdapterFields</name>
    <message>
        <location filename="../forms/adapters/adapter_fields.py" line="41"/>
        <source>Channel</source>
        <translation>Kanál</translation>
    </message>
    <message>
        <location filename="../forms/adapters/adapter_fields.py" line="40"/>
        <source>as the adapter&apos;s driver calls it</source>
        <translation>jak jej nazývá ovladač adaptéru</translation>
    </message>
    <message>
        <location filename="../forms/adapters/adapter_fields.py" line="45"/>
        <source>classic CAN</source>
        <translation>klasická CAN</translation>
    </message>
    <message>
        <location filename="../forms/adapters/adapter_fields.py" line="59"/>
        <source>None yet</source>
        <translation>Zatím žádný</translation>
    </message>
    <message>
        <location filename="../forms/adapters/adapter_fields.py" line="66"/>
        <source>CAN adapter</source>
        <translation>Adaptér CAN</translation>
    </message>
    <message>
        <location filename="../forms/adapters/adapter_fields.py" line="68"/>
        <source>Bit rate in bit/s</source>
        <translation>Přenosová rychlost v bit/s</translation>
    </message>
    <message>
        <location filename="../forms/adapters/adapter_fields.py" line="69"/>
        <source>CAN FD data in bit/s</source>
        <translation>Data CAN FD v bit/s</translation>
    </message>
</context>
<context>
    <name>AnnotationDialog</name>
    <message>
        <location filename="../screens/annotation_dialog.py" line="32"/>
        <source>Notes and photos</source>
        <translation>Poznámky a fotky</translation>
    </message>
    <message>
        <location filename="../screens/annotation_dialog.py" line="40"/>
        <source>With the test already: {names}.</source>
        <translation>U testu již: {names}.</translation>
    </message>
    <message>
        <location filename="../screens/annotation_dialog.py" line="42"/>
        <source>Further photos</source>
        <translation>Další fotografie</translation>
    </message>
    <message>
        <location filename="../screens/annotation_dialog.py" line="43"/>
        <source>Keep with the test</source>
        <translation>Uchovat u testu</translation>
    </message>
    <message>
        <location filename="../screens/annotation_dialog.py" line="53"/>
        <source>Close</source>
        <translation>Zavřít</translation>
    </message>
</context>
<context>
    <name>AppearanceForm</name>
    <message>
        <location filename="../windows/appearance_form.py" line="35"/>
        <source>Sounds</source>
        <translation>Zvuky</translation>
    </message>
    <message>
        <location filename="../windows/appearance_form.py" line="36"/>
        <source>One beep when the robot begins to move, two when the test is done, three at trouble</source>
        <translation>Jedno pípnutí, když se robot rozjíždí, dvě po skončení testu, tři při potížích</translation>
    </message>
    <message>
        <location filename="../windows/appearance_form.py" line="47"/>
        <source>As the system</source>
        <translation>Podle systému</translation>
    </message>
    <message>
        <location filename="../windows/appearance_form.py" line="47"/>
        <source>Light</source>
        <translation>Světlý</translation>
    </message>
    <message>
        <location filename="../windows/appearance_form.py" line="47"/>
        <source>Dark</source>
        <translation>Tmavý</translation>
    </message>
    <message>
        <location filename="../windows/appearance_form.py" line="48"/>
        <source>High contrast</source>
        <translation>Vysoký kontrast</translation>
    </message>
    <message>
        <location filename="../windows/appearance_form.py" line="56"/>
        <source>Speech</source>
        <translation>Řeč</translation>
    </message>
    <message>
        <location filename="../windows/appearance_form.py" line="59"/>
        <source>Says what the beeps mean, and what the trouble is</source>
        <translation>Řekne, co pípnutí znamenají a jaká je potíž</translation>
    </message>
    <message>
        <location filename="../windows/appearance_form.py" line="59"/>
        <source>This computer cannot speak: Qt&apos;s text to speech or an engine for it is missing (Debian: python3-pyqt5.qttexttospeech, speech-dispatcher)</source>
        <translation>Tento počítač neumí mluvit: chybí převod textu na řeč z Qt nebo jeho nástroj (Debian: python3-pyqt5.qttexttospeech, speech-dispatcher)</translation>
    </message>
    <message>
        <location filename="../windows/appearance_form.py" line="69"/>
        <source>Theme</source>
        <translation>Motiv</translation>
    </message>
    <message>
        <location filename="../windows/appearance_form.py" line="69"/>
        <source>Language</source>
        <translation>Jazyk</translation>
    </message>
</context>
<context>
    <name>AreaView</name>
    <message>
        <location filename="../area/area_view.py" line="41"/>
        <source>Test area from above. Arrows move the cross, Shift by a metre; Space adds a corner, Return picks and drops one, Delete removes one, Ctrl+Z undoes.</source>
        <translation>Zkušební prostor shora. Šipky posouvají křížek, se Shiftem o metr; mezerník přidá roh, Enter roh uchopí a pustí, Delete ho odstraní, Ctrl+Z vezme krok zpět.</translation>
    </message>
</context>
<context>
    <name>AreaWindow</name>
    <message>
        <location filename="../area/area_window.py" line="40"/>
        <source>Test area</source>
        <translation>Zkušební prostor</translation>
    </message>
    <message>
        <location filename="../area/area_window.py" line="47"/>
        <source>Rectangle around the robot</source>
        <translation>Obdélník kolem robotu</translation>
    </message>
    <message>
        <location filename="../area/area_window.py" line="48"/>
        <source>Edit the robot&apos;s area</source>
        <translation>Upravit prostor robotu</translation>
    </message>
    <message>
        <location filename="../area/area_window.py" line="49"/>
        <source>Undo</source>
        <translation>Zpět</translation>
    </message>
    <message>
        <location filename="../area/area_window.py" line="49"/>
        <source>Clear</source>
        <translation>Vymazat</translation>
    </message>
    <message>
        <location filename="../area/area_window.py" line="50"/>
        <source>Set area</source>
        <translation>Nastavit prostor</translation>
    </message>
    <message>
        <location filename="../area/area_window.py" line="52"/>
        <source>Remove the robot&apos;s area</source>
        <translation>Odstranit prostor robotu</translation>
    </message>
    <message>
        <location filename="../area/area_window.py" line="85"/>
        <source>Close</source>
        <translation>Zavřít</translation>
    </message>
    <message>
        <location filename="../area/area_window.py" line="178"/>
        <source>The robot is silent, or its software is too old to keep a test area.</source>
        <translation>Robot mlčí, nebo je jeho software pro zkušební prostor příliš starý.</translation>
    </message>
    <message>
        <location filename="../area/area_window.py" line="182"/>
        <source>The robot has no test area; a simulated robot needs none.</source>
        <translation>Robot nemá zkušební prostor; simulovaný robot ho nepotřebuje.</translation>
    </message>
    <message>
        <location filename="../area/area_window.py" line="183"/>
        <source>The robot&apos;s launch file sets this test area of {size} m2.</source>
        <translation>Tento zkušební prostor o {size} m2 určuje spouštěcí soubor robotu.</translation>
    </message>
    <message>
        <location filename="../area/area_window.py" line="183"/>
        <source>The robot keeps inside this test area of {size} m2.</source>
        <translation>Robot neopustí tento zkušební prostor o {size} m2.</translation>
    </message>
    <message>
        <location filename="../area/area_window.py" line="194"/>
        <source>Waits until the robot confirms the area.</source>
        <translation>Čeká se, až robot prostor potvrdí.</translation>
    </message>
    <message>
        <location filename="../area/area_window.py" line="196"/>
        <source>Click the corners one after the other, or begin with a rectangle. Drag a corner to move it, right-click it to remove it.</source>
        <translation>Klikejte rohy jeden po druhém, nebo začněte obdélníkem. Roh posunete tažením a odstraníte pravým tlačítkem.</translation>
    </message>
    <message>
        <location filename="../area/area_window.py" line="198"/>
        <source>Drawn: {count} corners, {size} m2. Set it, then check that it is shown in green.</source>
        <translation>Nakresleno rohů: {count}, {size} m2. Nastavte prostor a ověřte, že se ukáže zeleně.</translation>
    </message>
</context>
<context>
    <name>BatterySymbol</name>
    <message>
        <location filename="../header/symbols.py" line="46"/>
        <source>Battery of the robot: unknown</source>
        <translation>Baterie robotu: neznámá</translation>
    </message>
    <message>
        <location filename="../header/symbols.py" line="47"/>
        <source>Battery of the robot: {percent} %</source>
        <translation>Baterie robotu: {percent} %</translation>
    </message>
    <message>
        <location filename="../header/symbols.py" line="49"/>
        <source>({age} s ago)</source>
        <translation>(před {age} s)</translation>
    </message>
</context>
<context>
    <name>BudgetModel</name>
    <message>
        <location filename="../screens/budget_model.py" line="27"/>
        <source>Distance</source>
        <translation>Vzdálenost</translation>
    </message>
    <message>
        <location filename="../screens/budget_model.py" line="27"/>
        <source>Part of its uncertainty</source>
        <translation>Složka nejistoty</translation>
    </message>
    <message>
        <location filename="../screens/budget_model.py" line="27"/>
        <source>In common</source>
        <translation>Společná</translation>
    </message>
    <message>
        <location filename="../screens/budget_model.py" line="27"/>
        <source>From</source>
        <translation>Zdroj</translation>
    </message>
    <message>
        <location filename="../screens/budget_model.py" line="34"/>
        <source>yes</source>
        <translation>ano</translation>
    </message>
    <message>
        <location filename="../screens/budget_model.py" line="34"/>
        <source>no</source>
        <translation>ne</translation>
    </message>
    <message>
        <location filename="../screens/budget_model.py" line="37"/>
        <source>expanded uncertainty, 95 %</source>
        <translation>rozšířená nejistota, 95 %</translation>
    </message>
</context>
<context>
    <name>BundleCheck</name>
    <message>
        <location filename="../evidence/bundle_check.py" line="46"/>
        <source>{name} is not as it was signed: {problems}</source>
        <translation>{name} není tak, jak byl podepsán: {problems}</translation>
    </message>
    <message>
        <location filename="../evidence/bundle_check.py" line="48"/>
        <source>{name} is intact: {count} files, bundle {number} of {station}, signed {time} with the key {key}; compare it with the station&apos;s.</source>
        <translation>{name} je neporušený: {count} souborů, balíček {number} stanice {station}, podepsán {time} klíčem {key}; porovnejte jej s klíčem stanice.</translation>
    </message>
</context>
<context>
    <name>BusForm</name>
    <message>
        <location filename="../forms/adapters/bus_forms.py" line="24"/>
        <source>Bus {name}</source>
        <translation>Sběrnice {name}</translation>
    </message>
    <message>
        <location filename="../forms/adapters/bus_forms.py" line="26"/>
        <source>The Car&apos;s profile needs this bus, too. Its adapter only listens.</source>
        <translation>Profil auta potřebuje i tuto sběrnici. Její adaptér jen naslouchá.</translation>
    </message>
</context>
<context>
    <name>BusWindow</name>
    <message>
        <location filename="../bus/bus_window.py" line="48"/>
        <source>Live bus view</source>
        <translation>Živý pohled na sběrnici</translation>
    </message>
    <message>
        <location filename="../bus/bus_window.py" line="64"/>
        <source>Messages of the bus</source>
        <translation>Zprávy sběrnice</translation>
    </message>
    <message>
        <location filename="../bus/bus_window.py" line="71"/>
        <source>Close</source>
        <translation>Zavřít</translation>
    </message>
    <message>
        <location filename="../bus/bus_window.py" line="74"/>
        <source>The Car&apos;s locks, and below them the key&apos;s distance from the Car&apos;s outline</source>
        <translation>Zámky auta a pod nimi vzdálenost klíče od obrysu auta</translation>
    </message>
    <message>
        <location filename="../bus/bus_window.py" line="116"/>
        <source>There is no bus: the Car is a substitute inside the application.</source>
        <translation>Žádná sběrnice tu není: auto je náhradou uvnitř aplikace.</translation>
    </message>
    <message>
        <location filename="../bus/bus_window.py" line="120"/>
        <source>Load {load} %, {count} messages.</source>
        <translation>Vytížení {load} %, zpráv: {count}.</translation>
    </message>
    <message>
        <location filename="../bus/bus_window.py" line="123"/>
        <source>{count} frames of further messages are not shown.</source>
        <translation>Rámce dalších zpráv, které se nezobrazují: {count}.</translation>
    </message>
    <message>
        <location filename="../bus/bus_window.py" line="131"/>
        <source>Nothing is known of the locks yet.</source>
        <translation>O zámcích zatím není nic známo.</translation>
    </message>
    <message>
        <location filename="../bus/bus_window.py" line="133"/>
        <source>Now: {locks}.</source>
        <translation>Nyní: {locks}.</translation>
    </message>
    <message>
        <location filename="../bus/bus_window.py" line="134"/>
        <source>Now: {locks}, key at {distance} m.</source>
        <translation>Nyní: {locks}, klíč ve vzdálenosti {distance} m.</translation>
    </message>
    <message>
        <location filename="../bus/bus_window.py" line="139"/>
        <source>Last change {age} s ago: {locks}.</source>
        <translation>Poslední změna před {age} s: {locks}.</translation>
    </message>
    <message>
        <location filename="../bus/bus_window.py" line="139"/>
        <source>Last change {age} s ago: {locks}, key at {distance} m.</source>
        <translation>Poslední změna před {age} s: {locks}, klíč ve vzdálenosti {distance} m.</translation>
    </message>
    <message>
        <location filename="../bus/bus_window.py" line="126"/>
        <source>Frames are timed by {clock}.</source>
        <translation>Čas rámců udávají {clock}.</translation>
    </message>
</context>
<context>
    <name>CalibrationWindow</name>
    <message>
        <location filename="../windows/calibration_window.py" line="62"/>
        <source>Calibration</source>
        <translation>Kalibrace</translation>
    </message>
    <message>
        <location filename="../windows/calibration_window.py" line="70"/>
        <source>Lock</source>
        <translation>Zamknout</translation>
    </message>
    <message>
        <location filename="../windows/calibration_window.py" line="70"/>
        <source>Unlock</source>
        <translation>Odemknout</translation>
    </message>
    <message>
        <location filename="../windows/calibration_window.py" line="80"/>
        <source>Send</source>
        <translation>Odeslat</translation>
    </message>
    <message>
        <location filename="../windows/calibration_window.py" line="124"/>
        <source>Wanted</source>
        <translation>Požadováno</translation>
    </message>
    <message>
        <location filename="../windows/calibration_window.py" line="127"/>
        <source>Buttons to press</source>
        <translation>Tlačítka ke stisknutí</translation>
    </message>
    <message>
        <location filename="../windows/calibration_window.py" line="139"/>
        <source>Key height</source>
        <translation>Výška klíče</translation>
    </message>
    <message>
        <location filename="../windows/calibration_window.py" line="139"/>
        <source>Buttons pressed</source>
        <translation>Stisknutá tlačítka</translation>
    </message>
    <message>
        <location filename="../windows/calibration_window.py" line="97"/>
        <source>Close</source>
        <translation>Zavřít</translation>
    </message>
    <message>
        <location filename="../windows/calibration_window.py" line="179"/>
        <source>none</source>
        <translation>žádné</translation>
    </message>
    <message>
        <location filename="../windows/calibration_window.py" line="198"/>
        <source>Pressed for {duration} s.</source>
        <translation>Stisknuto po dobu {duration} s.</translation>
    </message>
    <message>
        <location filename="../windows/calibration_window.py" line="216"/>
        <source>Sent.</source>
        <translation>Odesláno.</translation>
    </message>
    <message>
        <location filename="../windows/calibration_window.py" line="138"/>
        <source>Reported by robot and Car</source>
        <translation>Hlásí robot a auto</translation>
    </message>
    <message>
        <location filename="../windows/calibration_window.py" line="140"/>
        <source>The Car&apos;s locks</source>
        <translation>Zámky auta</translation>
    </message>
    <message>
        <location filename="../windows/calibration_window.py" line="199"/>
        <source>The Car has answered: {locks}.</source>
        <translation>Auto odpovědělo: {locks}.</translation>
    </message>
    <message>
        <location filename="../windows/calibration_window.py" line="200"/>
        <source>The Car has not answered.</source>
        <translation>Auto neodpovědělo.</translation>
    </message>
    <message>
        <location filename="../windows/calibration_window.py" line="77"/>
        <source>Guided calibration</source>
        <translation>Kalibrace krok za krokem</translation>
    </message>
    <message>
        <location filename="../windows/calibration_window.py" line="78"/>
        <source>Press strength, key height and key&apos;s lever, kept with their date.</source>
        <translation>Síla stisku, výška klíče a rameno klíče; uchovají se s datem.</translation>
    </message>
</context>
<context>
    <name>CanForm</name>
    <message>
        <location filename="../forms/can_form.py" line="35"/>
        <source>Simulated Car (to try the application)</source>
        <translation>Simulované auto (na zkoušku)</translation>
    </message>
    <message>
        <location filename="../forms/can_form.py" line="40"/>
        <source>Without an adapter everything but a test works.</source>
        <translation>Bez adaptéru funguje vše kromě testu.</translation>
    </message>
    <message>
        <location filename="../forms/can_form.py" line="56"/>
        <source>Car profile</source>
        <translation>Profil auta</translation>
    </message>
    <message>
        <location filename="../forms/can_form.py" line="36"/>
        <source>Take part in the bus (a bench of one node)</source>
        <translation>Účastnit se sběrnice (stůl o 1 uzlu)</translation>
    </message>
    <message>
        <location filename="../forms/can_form.py" line="37"/>
        <source>The adapter acknowledges frames. Without it the adapter only listens and sends nothing: a Car does not notice it.</source>
        <translation>Adaptér potvrzuje rámce. Jinak jen naslouchá a nic nevysílá: auto si ho nevšimne.</translation>
    </message>
    <message>
        <location filename="../forms/can_form.py" line="43"/>
        <source>Learn a new Car from its bus</source>
        <translation>Naučit nové auto z jeho sběrnice</translation>
    </message>
</context>
<context>
    <name>CandidateModel</name>
    <message>
        <location filename="../learn/candidate_model.py" line="42"/>
        <source>Identifier</source>
        <translation>Identifikátor</translation>
    </message>
    <message>
        <location filename="../learn/candidate_model.py" line="42"/>
        <source>Byte.bits</source>
        <translation>Bajt.bity</translation>
    </message>
    <message>
        <location filename="../learn/candidate_model.py" line="42"/>
        <source>Locked</source>
        <translation>Zamčeno</translation>
    </message>
    <message>
        <location filename="../learn/candidate_model.py" line="42"/>
        <source>Unlocked</source>
        <translation>Odemčeno</translation>
    </message>
    <message>
        <location filename="../learn/candidate_model.py" line="42"/>
        <source>Followed</source>
        <translation>Odpovídalo</translation>
    </message>
    <message>
        <location filename="../learn/candidate_model.py" line="42"/>
        <source>Later by</source>
        <translation>Později o</translation>
    </message>
    <message>
        <location filename="../learn/candidate_model.py" line="42"/>
        <source>Cycle</source>
        <translation>Perioda</translation>
    </message>
    <message>
        <location filename="../learn/candidate_model.py" line="42"/>
        <source>Besides</source>
        <translation>Dále</translation>
    </message>
</context>
<context>
    <name>CarCard</name>
    <message>
        <location filename="../windows/car_card.py" line="25"/>
        <source>Car</source>
        <translation>Auto</translation>
    </message>
    <message>
        <location filename="../windows/car_card.py" line="57"/>
        <source>The robot maps the Car.</source>
        <translation>Robot mapuje auto.</translation>
    </message>
    <message>
        <location filename="../windows/car_card.py" line="59"/>
        <source>The robot checks where the Car stands.</source>
        <translation>Robot ověřuje, kde auto stojí.</translation>
    </message>
    <message>
        <location filename="../windows/car_card.py" line="64"/>
        <source>The Car is not measured yet.</source>
        <translation>Auto ještě není změřeno.</translation>
    </message>
    <message>
        <location filename="../windows/car_card.py" line="65"/>
        <source>The Car measures {length} m by {width} m.</source>
        <translation>Auto měří {length} m × {width} m.</translation>
    </message>
    <message>
        <location filename="../windows/car_card.py" line="55"/>
        <source>The robot was stopped on its way around the Car.</source>
        <translation>Robot byl zastaven na cestě kolem auta.</translation>
    </message>
    <message>
        <location filename="../windows/car_card.py" line="28"/>
        <source>Hold to check its position</source>
        <translation>Podržením zkontrolovat polohu</translation>
    </message>
    <message>
        <location filename="../windows/car_card.py" line="50"/>
        <source>Hold to map it again</source>
        <translation>Podržením znovu zmapovat</translation>
    </message>
    <message>
        <location filename="../windows/car_card.py" line="30"/>
        <source>The robot drives around the Car for both: hold the button when its way is clear.</source>
        <translation>Robot při obojím objíždí auto: tlačítko podržte, až bude cesta volná.</translation>
    </message>
    <message>
        <location filename="../windows/car_card.py" line="50"/>
        <source>Hold to map it</source>
        <translation>Podržením zmapovat</translation>
    </message>
</context>
<context>
    <name>Check</name>
    <message>
        <location filename="../../station/checks/check_texts.py" line="41"/>
        <source>Link</source>
        <translation>Spojení</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="41"/>
        <source>Encryption</source>
        <translation>Šifrování</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="42"/>
        <source>Robot</source>
        <translation>Robot</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="43"/>
        <source>Emergency stop</source>
        <translation>Nouzové zastavení</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="44"/>
        <source>Position</source>
        <translation>Poloha</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="53"/>
        <source>LiDARs</source>
        <translation>Lidary</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="53"/>
        <source>Lift and buttons</source>
        <translation>Zdvih a tlačítka</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="54"/>
        <source>Battery</source>
        <translation>Baterie</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="55"/>
        <source>CAN bus</source>
        <translation>Sběrnice CAN</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="55"/>
        <source>Car&apos;s locks</source>
        <translation>Zámky auta</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="57"/>
        <source>Clocks</source>
        <translation>Hodiny</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="58"/>
        <source>Remote key</source>
        <translation>Klíč</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="59"/>
        <source>Disk</source>
        <translation>Disk</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="59"/>
        <source>Limits</source>
        <translation>Meze</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="82"/>
        <source>Not known while the robot is silent.</source>
        <translation>Dokud robot mlčí, není známo.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="83"/>
        <source>The robot&apos;s newest message is {first} s old.</source>
        <translation>Nejnovější zpráva robotu je stará {first} s.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="84"/>
        <source>The robot has not answered for {first} s.</source>
        <translation>Robot už {first} s neodpovídá.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="85"/>
        <source>The link to the robot is encrypted.</source>
        <translation>Spojení s robotem je šifrované.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="86"/>
        <source>The link is not encrypted: whoever is in its network can listen and send.</source>
        <translation>Spojení není šifrované: kdo je v jeho síti, může poslouchat i vysílat.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="94"/>
        <source>It takes orders, and reports nothing against a test.</source>
        <translation>Přijímá pokyny a nehlásí nic, co by bránilo testu.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="95"/>
        <source>The robot is still starting.</source>
        <translation>Robot se ještě spouští.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="96"/>
        <source>The robot reports a fault.</source>
        <translation>Robot hlásí poruchu.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="97"/>
        <source>Another application controls the robot.</source>
        <translation>Robot ovládá jiná aplikace.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="99"/>
        <source>The one by hand is heard, and released.</source>
        <translation>Ruční ovladač je slyšet a je uvolněný.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="100"/>
        <source>The one by hand is engaged: the robot stands.</source>
        <translation>Na ručním ovladači je stisknuto: robot stojí.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="101"/>
        <source>The robot has none by hand.</source>
        <translation>Robot nemá ruční ovladač.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="103"/>
        <source>The robot does not say whether it has one by hand.</source>
        <translation>Robot neříká, zda má ruční ovladač.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="136"/>
        <source>Known beside the Car.</source>
        <translation>Vůči autu známa.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="137"/>
        <source>Not known yet: a test begins with a drive around the Car.</source>
        <translation>Zatím neznámá: test začíná objetím auta.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="138"/>
        <source>The robot does not know its position.</source>
        <translation>Robot nezná svou polohu.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="108"/>
        <source>The robot reports nothing against them.</source>
        <translation>Robot nehlásí nic, co by mluvilo proti nim.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="222"/>
        <source>At {first} %; what a test takes is told when it is chosen.</source>
        <translation>Na {first} %; kolik test spotřebuje, se ukáže po jeho zvolení.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="223"/>
        <source>At {first} %; the test takes about {second} %.</source>
        <translation>Na {first} %; test spotřebuje asi {second} %.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="224"/>
        <source>At {first} % it may not suffice: the test takes about {second} %.</source>
        <translation>Na {first} % nemusí stačit: test spotřebuje asi {second} %.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="225"/>
        <source>Low: {first} %.</source>
        <translation>Slabá: {first} %.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="226"/>
        <source>Nearly empty: {first} %.</source>
        <translation>Téměř vybitá: {first} %.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="234"/>
        <source>Load {first} %, lock message every {second} ms.</source>
        <translation>Vytížení {first} %, zpráva o zámcích každých {second} ms.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="235"/>
        <source>Load {first} %, no lock message yet.</source>
        <translation>Vytížení {first} %, zpráva o zámcích zatím nepřišla.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="236"/>
        <source>There is none: the Car is a substitute inside the application.</source>
        <translation>Žádná není: auto je náhrada uvnitř aplikace.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="237"/>
        <source>Load {first} %: messages may be late, and so the time of events.</source>
        <translation>Vytížení {first} %: zprávy se mohou opožďovat, a s nimi čas událostí.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="238"/>
        <source>The lock message comes every {first} ms; the profile says {second} ms.</source>
        <translation>Zpráva o zámcích chodí každých {first} ms; profil uvádí {second} ms.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="239"/>
        <source>No CAN adapter is chosen.</source>
        <translation>Není zvolen žádný adaptér CAN.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="240"/>
        <source>The Car says: {said}.</source>
        <translation>Auto hlásí: {said}.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="241"/>
        <source>The Car does not say whether it is locked.</source>
        <translation>Auto neříká, zda je zamčené.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="242"/>
        <source>Events of the Car have a time on the robot&apos;s clock.</source>
        <translation>Události auta mají čas na hodinách robotu.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="243"/>
        <source>Not known without an adapter.</source>
        <translation>Bez adaptéru není známo.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="244"/>
        <source>The Car has reacted {first} s ago: the key is awake.</source>
        <translation>Auto reagovalo před {first} s: klíč je vzhůru.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="245"/>
        <source>Whether it is awake nobody knows before the Car reacts to it.</source>
        <translation>Zda je vzhůru, se pozná, až na něj auto zareaguje.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="252"/>
        <source>{first} GB are free.</source>
        <translation>Volných je {first} GB.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="253"/>
        <source>Only {first} GB are free.</source>
        <translation>Volných je jen {first} GB.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="254"/>
        <source>Nearly full: {first} GB are free.</source>
        <translation>Téměř plný: volných je {first} GB.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="255"/>
        <source>The system does not say how much room there is.</source>
        <translation>Systém neříká, kolik je na něm místa.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="256"/>
        <source>Limits loaded: {first}.</source>
        <translation>Načtené meze: {first}.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="257"/>
        <source>None: the lines get no verdict.</source>
        <translation>Žádné: přímky nebudou hodnoceny.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="265"/>
        <source>Check the Wi-Fi and that the robot is on; the link comes back by itself.</source>
        <translation>Zkontrolujte Wi-Fi a že je robot zapnutý; spojení se obnoví samo.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="269"/>
        <source>Wait a moment.</source>
        <translation>Chvíli počkejte.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="270"/>
        <source>Make sure that nothing blocks the robot; if the fault stays, switch it off and on.</source>
        <translation>Ujistěte se, že robotu nic nebrání; pokud porucha trvá, vypněte jej a zapněte.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="272"/>
        <source>End the other application; control comes here by itself.</source>
        <translation>Ukončete druhou aplikaci; řízení sem přejde samo.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="285"/>
        <source>Release it when the area is clear.</source>
        <translation>Uvolněte je, až bude prostor volný.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="286"/>
        <source>Stay where you reach the button on the robot.</source>
        <translation>Zůstaňte tam, kde dosáhnete na tlačítko na robotu.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="299"/>
        <source>Drive or turn it by hand where it sees the Car; if it stays lost, map the Car again under Calibrate.</source>
        <translation>Popojeďte s ním nebo ho otočte ručně tam, kde vidí auto; pokud polohu nenajde, zmapujte auto znovu v Kalibraci.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="311"/>
        <source>Charge it, or measure fewer lines; an interrupted test can be gone on with.</source>
        <translation>Nabijte ji, nebo změřte méně přímek; v přerušeném testu lze pokračovat.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="313"/>
        <source>Charge it soon.</source>
        <translation>Brzy ji nabijte.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="314"/>
        <source>Charge it before the test.</source>
        <translation>Před testem ji nabijte.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="317"/>
        <source>Check bit rate and other testers on the bus.</source>
        <translation>Zkontrolujte rychlost a další testery na sběrnici.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="318"/>
        <source>Check whether the profile is that of this Car.</source>
        <translation>Zkontrolujte, zda profil patří tomuto autu.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="319"/>
        <source>Choose one under Settings, CAN adapter.</source>
        <translation>Zvolte jej v Nastavení, Adaptér CAN.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="320"/>
        <source>If the adapter is the wrong one, choose another under Settings.</source>
        <translation>Pokud je to jiný adaptér, zvolte správný v Nastavení.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="321"/>
        <source>Wake the Car, e.g. open a door; check the car profile.</source>
        <translation>Probuďte auto, např. otevřete dveře; zkontrolujte profil auta.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="322"/>
        <source>Press one of its buttons under Calibrate; a test notices a key that sleeps.</source>
        <translation>Stiskněte v Kalibraci některé jeho tlačítko; test pozná, že klíč spí.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="325"/>
        <source>Make room, or choose another folder under Settings.</source>
        <translation>Uvolněte místo, nebo zvolte v Nastavení jinou složku.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="326"/>
        <source>Choose a limits file below the parameters if there are limits.</source>
        <translation>Jsou-li předepsané meze, zvolte pod parametry jejich soubor.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="327"/>
        <source>Choose another file below the parameters, or none.</source>
        <translation>Zvolte pod parametry jiný soubor, nebo žádný.</translation>
    </message>
    <message>
        <location filename="../header/checklist_panel.py" line="78"/>
        <source>good</source>
        <translation>v pořádku</translation>
    </message>
    <message>
        <location filename="../header/checklist_panel.py" line="78"/>
        <source>note</source>
        <translation>upozornění</translation>
    </message>
    <message>
        <location filename="../header/checklist_panel.py" line="79"/>
        <source>not known</source>
        <translation>není známo</translation>
    </message>
    <message>
        <location filename="../header/checklist_panel.py" line="79"/>
        <source>hinders a test</source>
        <translation>brání testu</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="135"/>
        <source>Known beside the Car to {first} cm (1 sigma).</source>
        <translation>Vůči autu známa na {first} cm (1 sigma).</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="45"/>
        <source>Car&apos;s size</source>
        <translation>Rozměry auta</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="139"/>
        <source>The robot has it from the data sheet.</source>
        <translation>Robot je zná z technického listu.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="140"/>
        <source>Only as the LiDARs see it at their height: distances from the Car&apos;s outline may be up to {first} cm too long.</source>
        <translation>Jen tak, jak je vidí LiDARy ve své výšce: vzdálenosti od obrysu auta mohou být až o {first} cm delší.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="146"/>
        <source>Not known before the Car is mapped.</source>
        <translation>Neznámé, dokud není auto zmapováno.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="301"/>
        <source>Start the robot with length and width of the data sheet (car_file), and map the Car again.</source>
        <translation>Spusťte robot s délkou a šířkou z technického listu (car_file) a zmapujte auto znovu.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="309"/>
        <source>Have length and width of the Car&apos;s data sheet ready: the robot is started with them (car_file).</source>
        <translation>Mějte po ruce délku a šířku z technického listu auta: robot se s nimi spouští (car_file).</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="88"/>
        <source>Not encrypted; it does not leave this computer.</source>
        <translation>Nešifrováno; neopouští tento počítač.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="267"/>
        <source>Pair this laptop with the robot in the connection window, and have the robot encrypt its link.</source>
        <translation>Spárujte tento notebook s robotem v okně připojení a nechte robot šifrovat spojení.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="42"/>
        <source>Preflight</source>
        <translation>Kontrola robotu</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="114"/>
        <source>{first} of {second} right, {age} ago.</source>
        <translation>{first} z {second} v pořádku, před {age}.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="115"/>
        <source>{first} of {second} right, but {age} ago.</source>
        <translation>{first} z {second} v pořádku, ale už před {age}.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="116"/>
        <source>{first} of {second} wrong, {age} ago.</source>
        <translation>{first} z {second} špatně, před {age}.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="118"/>
        <source>Never made since the robot was started.</source>
        <translation>Od spuštění robotu nebyla provedena.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="119"/>
        <source>The robot does not say whether one was made.</source>
        <translation>Robot neříká, zda byla provedena.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="275"/>
        <source>Make it again on the robot: rosrun mtr_commissioning preflight</source>
        <translation>Proveďte ji na robotu znovu: rosrun mtr_commissioning preflight</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="276"/>
        <source>Then make it again on the robot: rosrun mtr_commissioning preflight</source>
        <translation>Potom ji na robotu proveďte znovu: rosrun mtr_commissioning preflight</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="46"/>
        <source>Way of the lines</source>
        <translation>Cesta přímek</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="152"/>
        <source>As far as the robot has seen, nothing stands on the lines.</source>
        <translation>Pokud robot viděl, na přímkách nic nestojí.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="153"/>
        <source>Something stands in the way of lines {lines}, the nearest {distance} m from the Car.</source>
        <translation>V cestě přímek {lines} něco stojí, nejblíže {distance} m od auta.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="155"/>
        <source>The robot has not seen all of the way of lines {lines}.</source>
        <translation>Robot neviděl celou cestu přímek {lines}.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="290"/>
        <source>Move it, or measure from nearer; the robot does not drive into it.</source>
        <translation>Odstraňte to, nebo měřte z menší vzdálenosti; robot do toho nevjede.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="157"/>
        <source>Looked at when the Car is mapped and a test is chosen.</source>
        <translation>Ověřuje se, až bude auto zmapováno a test vybrán.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="57"/>
        <source>Robot&apos;s clock</source>
        <translation>Hodiny robotu</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="104"/>
        <source>Within {first} s of this laptop&apos;s.</source>
        <translation>Od hodin tohoto notebooku se liší nejvýše o {first} s.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="106"/>
        <source>The robot tells simulated time.</source>
        <translation>Robot udává simulovaný čas.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="142"/>
        <source>Known to {first} cm (95 %): distances from the Car&apos;s outline may be wrong by as much.</source>
        <translation>Znám na {first} cm (95 %): o tolik mohou být vzdálenosti od obrysu auta chybné.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="144"/>
        <source>Known to {first} cm only (95 %): the robot may touch the Car nearer than {second} m.</source>
        <translation>Znám jen na {first} cm (95 %): blíže než {second} m se robot může auta dotknout.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="303"/>
        <source>Fill in {keys} in the robot&apos;s car_file (data sheet or tape measure), restart the robot with it, and map the Car again.</source>
        <translation>Doplňte {keys} do souboru car_file robotu (z technických údajů nebo změřte pásmem), spusťte s ním robot znovu a auto znovu zmapujte; nebo měřte z větší vzdálenosti.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="48"/>
        <source>Ground next to the Car</source>
        <translation>Zem vedle auta</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="48"/>
        <source>Cables</source>
        <translation>Kabely</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="49"/>
        <source>Doors and lids</source>
        <translation>Dveře a víka</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="49"/>
        <source>Fittings</source>
        <translation>Nástavby</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="165"/>
        <source>The LiDARs see nothing below their plane: no person lying or kneeling, no child, no wheel chocks.</source>
        <translation>LiDARy nevidí nic pod svou rovinou: nikoho, kdo leží nebo klečí, dítě ani zakládací klíny.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="167"/>
        <source>The robot does not see cables, and drives around the whole Car.</source>
        <translation>Robot kabely nevidí a objíždí celé auto.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="168"/>
        <source>The robot does not see an open door, lid or tailgate above the LiDARs. A hatch may open by itself for a key behind the Car.</source>
        <translation>Otevřené dveře, víko ani čelo korby nad LiDARy robot nevidí. Víko kufru se může samo otevřít, je-li klíč za autem.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="291"/>
        <source>Walk around the Car: nobody within 2 m, no chock beyond its outline.</source>
        <translation>Obejděte auto: do 2 m nikdo, žádný klín mimo jeho obrys.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="293"/>
        <source>Put the laptop into the Car, or tape the CAN cable flat to the ground. Unplug the charging cable.</source>
        <translation>Dejte notebook do auta, nebo kabel CAN přilepte naplocho k zemi. Nabíjecí kabel odpojte.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="295"/>
        <source>Close doors, bonnet, boot and tailgate. Switch off a hatch that opens by itself, in the Car&apos;s menu.</source>
        <translation>Zavřete dveře, kapotu, kufr i čelo korby. Samočinné otevírání kufru vypněte v nabídce auta.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="297"/>
        <source>Remove carriers and larger fittings, or start the robot with front_fitting_m or rear_fitting_m.</source>
        <translation>Odstraňte nosiče a větší nástavby, nebo robot spusťte s front_fitting_m nebo rear_fitting_m.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="306"/>
        <source>Fill in {keys} in the robot&apos;s car_file (data sheet or tape measure), restart the robot with it, and map the Car again; or measure from farther away.</source>
        <translation>Doplňte {keys} do souboru car_file robota (technický list nebo svinovací metr), restartujte s ním robota a zmapujte vozidlo znovu; nebo měřte z větší vzdálenosti.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="170"/>
        <source>The robot does not see what stands out above or below the LiDARs, such as a tow bar. It keeps 10 to 25 cm from the Car&apos;s ends.</source>
        <translation>Robot nevidí, co vyčnívá nad rovinou lidarů nebo pod ní, například tažné zařízení. Od konců auta udržuje 10 až 25 cm.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="227"/>
        <source>The robot does not report its charge.</source>
        <translation>Robot nehlásí stav nabití.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="315"/>
        <source>Check that the base publishes it on the robot&apos;s topic of the battery (docs/other-bases.md).</source>
        <translation>Ověřte, že jej podvozek publikuje na tématu baterie robotu (docs/other-bases.md).</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="44"/>
        <source>Test area</source>
        <translation>Zkušební prostor</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="125"/>
        <source>The robot keeps inside an area of {first} m2.</source>
        <translation>Robot neopustí prostor o {first} m2.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="126"/>
        <source>The robot&apos;s launch file sets an area of {first} m2.</source>
        <translation>Prostor o {first} m2 určuje spouštěcí soubor robotu.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="127"/>
        <source>The robot has none.</source>
        <translation>Robot žádný nemá.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="128"/>
        <source>None; a simulated robot needs none.</source>
        <translation>Žádný; simulovaný robot ho nepotřebuje.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="129"/>
        <source>The robot does not say whether it keeps inside one.</source>
        <translation>Robot nesděluje, zda nějaký dodržuje.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="278"/>
        <source>Draw it on the start page under Test area.</source>
        <translation>Nakreslete ho na úvodní stránce pod Zkušební prostor.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="279"/>
        <source>Stay where you can stop the robot before an edge.</source>
        <translation>Zůstaňte tam, kde robot zastavíte dřív než u hrany.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="50"/>
        <source>Area</source>
        <translation>Plocha</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="50"/>
        <source>People</source>
        <translation>Lidé</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="51"/>
        <source>Weather</source>
        <translation>Počasí</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="51"/>
        <source>Light</source>
        <translation>Světlo</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="52"/>
        <source>Car</source>
        <translation>Auto</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="52"/>
        <source>Attendance</source>
        <translation>Dozor</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="56"/>
        <source>Car&apos;s signals</source>
        <translation>Signály auta</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="117"/>
        <source>Made at rest only; a real robot needs one in motion.</source>
        <translation>Provedena jen vstoje; skutečný robot potřebuje kontrolu za jízdy.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="179"/>
        <source>Closed or marked, 2 m free around the paths, no edge, stairs, dock or kerb inside?</source>
        <translation>Uzavřená nebo vyznačená, 2 m volno kolem drah, uvnitř žádná hrana, schody, rampa ani obrubník?</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="181"/>
        <source>Trained adults only, nobody lies, kneels or works at the Car?</source>
        <translation>Jen poučení dospělí, nikdo u auta neleží, nekleká ani nepracuje?</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="182"/>
        <source>No ice, snow, heavy rain or fog, no low sun into a LiDAR, mean wind below 8 m/s?</source>
        <translation>Žádný led, sníh, silný déšť ani mlha, žádné nízké slunce do LiDARu, průměrný vítr pod 8 m/s?</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="184"/>
        <source>Is the area lit?</source>
        <translation>Je plocha osvětlená?</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="185"/>
        <source>Parking brake applied, gear P, chocks placed, cabin empty, windows closed, alarm off or announced?</source>
        <translation>Ruční brzda zatažená, zařazeno P, klíny založené, kabina prázdná, okna zavřená, alarm vypnutý nebo ohlášený?</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="187"/>
        <source>Is a trained person within 10 m and in sight of the robot, with a hardware emergency stop?</source>
        <translation>Je do 10 m a na dohled od robotu poučená osoba s hardwarovým nouzovým zastavením?</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="189"/>
        <source>Confirmed by a person.</source>
        <translation>Potvrzeno osobou.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="202"/>
        <source>Dry or wet asphalt or concrete, steps and cables below 15 mm, slope at most 2 degrees?</source>
        <translation>Suchý nebo mokrý asfalt či beton, schůdky a kabely pod 15 mm, sklon nejvýše 2 stupně?</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="212"/>
        <source>Ignition, gear, speed and doors are received, and do not forbid motion.</source>
        <translation>Zapalování, řazení, rychlost a dveře se přijímají a jízdě nebrání.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="214"/>
        <source>Not received from the Car: {signals}.</source>
        <translation>Z auta nepřicházejí: {signals}.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="215"/>
        <source>The car profile names no signal for: {signals}.</source>
        <translation>Profil auta neuvádí signál pro: {signals}.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="280"/>
        <source>Make it on the robot: rosrun mtr_commissioning preflight --drive</source>
        <translation>Proveďte ji na robotu: rosrun mtr_commissioning preflight --drive</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="282"/>
        <source>Close it.</source>
        <translation>Zavřete je.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="283"/>
        <source>Wake the Car; watch ignition, gear and doors yourself meanwhile.</source>
        <translation>Probuďte auto; zatím sami sledujte zapalování, řazení a dveře.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="284"/>
        <source>Watch them yourself: the robot does not stop for them.</source>
        <translation>Sledujte je sami: robot kvůli nim nezastaví.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="47"/>
        <source>Stop trial</source>
        <translation>Zkouška zastavení</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="102"/>
        <source>The robot has none by hand, so no test begins.</source>
        <translation>Robot nemá ruční nouzové zastavení, proto žádná zkouška nezačne.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="163"/>
        <source>The robot may not notice a lost controller while its receiver stays plugged in.</source>
        <translation>Ztrátu ovladače robot nemusí poznat, dokud zůstává zapojený jeho přijímač.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="287"/>
        <source>Start the robot with its controller (controller:=true).</source>
        <translation>Spusťte robot s ručním ovladačem (controller:=true).</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="288"/>
        <source>Press the stop button in your hand: the robot reports it here. Then release it.</source>
        <translation>Stiskněte tlačítko zastavení v ruce: robot to zde ohlásí. Pak jej uvolněte.</translation>
    </message>
    <message>
        <location filename="../../station/checks/check_texts.py" line="273"/>
        <source>When the work is finished, release it here under Settings and on the robot: rosrun mtr_dispatcher service_mode release</source>
        <translation>Po skončení práce ho uvolněte zde v Nastavení a na robotu: rosrun mtr_dispatcher service_mode release</translation>
    </message>
</context>
<context>
    <name>CogwheelButton</name>
    <message>
        <location filename="../header/symbols.py" line="170"/>
        <source>Settings</source>
        <translation>Nastavení</translation>
    </message>
</context>
<context>
    <name>Comparison</name>
    <message>
        <location filename="../history/comparison_model.py" line="87"/>
        <source>farther</source>
        <translation>dále</translation>
    </message>
    <message>
        <location filename="../history/comparison_model.py" line="87"/>
        <source>nearer</source>
        <translation>blíže</translation>
    </message>
    <message>
        <location filename="../history/comparison_model.py" line="88"/>
        <source>no difference shown</source>
        <translation>rozdíl neprokázán</translation>
    </message>
    <message>
        <location filename="../history/comparison_model.py" line="89"/>
        <source>not known</source>
        <translation>není známo</translation>
    </message>
    <message>
        <location filename="../history/comparison_picture.py" line="25"/>
        <source>First test</source>
        <translation>První test</translation>
    </message>
    <message>
        <location filename="../history/comparison_picture.py" line="25"/>
        <source>Second test</source>
        <translation>Druhý test</translation>
    </message>
    <message>
        <location filename="../history/comparison_model.py" line="70"/>
        <source>{first} to {last}, moved together</source>
        <translation>{first} až {last}, posunuly se společně</translation>
    </message>
</context>
<context>
    <name>ComparisonModel</name>
    <message>
        <location filename="../history/comparison_model.py" line="47"/>
        <source>Second test</source>
        <translation>Druhý test</translation>
    </message>
    <message>
        <location filename="../history/comparison_model.py" line="47"/>
        <source>Difference</source>
        <translation>Rozdíl</translation>
    </message>
    <message>
        <location filename="../history/comparison_model.py" line="47"/>
        <source>Chance among all</source>
        <translation>p mezi všemi</translation>
    </message>
    <message>
        <location filename="../history/comparison_model.py" line="47"/>
        <source>First</source>
        <translation>První</translation>
    </message>
    <message>
        <location filename="../history/comparison_model.py" line="47"/>
        <source>Second</source>
        <translation>Druhý</translation>
    </message>
</context>
<context>
    <name>ComparisonWindow</name>
    <message>
        <location filename="../history/comparison_window.py" line="29"/>
        <source>Two tests compared</source>
        <translation>Porovnání dvou testů</translation>
    </message>
    <message>
        <location filename="../history/comparison_window.py" line="46"/>
        <source>First: {test}</source>
        <translation>První: {test}</translation>
    </message>
    <message>
        <location filename="../history/comparison_window.py" line="47"/>
        <source>Second: {test}</source>
        <translation>Druhý: {test}</translation>
    </message>
    <message>
        <location filename="../history/comparison_window.py" line="56"/>
        <source>Lines of one test only: {first} of the first, {second} of the second.</source>
        <translation>Přímky jen jednoho testu: {first} prvního, {second} druhého.</translation>
    </message>
    <message>
        <location filename="../history/comparison_window.py" line="48"/>
        <source>{count} {change}</source>
        <translation>{count}krát {change}</translation>
    </message>
    <message>
        <location filename="../history/comparison_window.py" line="31"/>
        <source>Differences of distances, sides and areas</source>
        <translation>Rozdíly vzdáleností, stran a ploch</translation>
    </message>
    <message>
        <location filename="../history/comparison_window.py" line="50"/>
        <source>Distances one by one: {counts}.</source>
        <translation>Vzdálenosti jednotlivě: {counts}.</translation>
    </message>
    <message>
        <location filename="../history/comparison_window.py" line="51"/>
        <source>Farther or nearer: the whole 95 % interval of the difference is on that side of zero. A star marks what also differs among all rows (Holm&apos;s correction); without a true difference, 95 of 100 comparisons have no star.</source>
        <translation>Dále nebo blíže: celý 95% interval rozdílu leží na té straně nuly. Hvězdička označuje, co se liší i mezi všemi řádky (Holmova korekce); bez skutečného rozdílu nemá 95 ze 100 porovnání žádnou hvězdičku.</translation>
    </message>
    <message>
        <location filename="../history/comparison_window.py" line="66"/>
        <source>No difference is shown among all rows.</source>
        <translation>Mezi všemi řádky není prokázán žádný rozdíl.</translation>
    </message>
    <message>
        <location filename="../history/comparison_window.py" line="69"/>
        <source>Different among all rows: {names}.</source>
        <translation>Mezi všemi řádky se liší: {names}.</translation>
    </message>
</context>
<context>
    <name>ConditionsForm</name>
    <message>
        <location filename="../header/conditions_form.py" line="33"/>
        <source>Confirm each operating condition:</source>
        <translation>Potvrďte každou provozní podmínku:</translation>
    </message>
</context>
<context>
    <name>ConnectionWindow</name>
    <message>
        <location filename="../windows/connection_window.py" line="37"/>
        <source>Connect to the robot</source>
        <translation>Připojení k robotu</translation>
    </message>
    <message>
        <location filename="../windows/connection_window.py" line="69"/>
        <source>Connect</source>
        <translation>Připojit</translation>
    </message>
    <message>
        <location filename="../windows/connection_window.py" line="73"/>
        <source>Robot</source>
        <translation>Robot</translation>
    </message>
    <message>
        <location filename="../windows/connection_window.py" line="73"/>
        <source>Car</source>
        <translation>Auto</translation>
    </message>
    <message>
        <location filename="../windows/connection_window.py" line="141"/>
        <source>The IP address or port provided is invalid.</source>
        <translation>Zadaná IP adresa nebo port je neplatný.</translation>
    </message>
    <message>
        <location filename="../windows/connection_window.py" line="132"/>
        <source>Connecting to {host} ...</source>
        <translation>Připojuji se k {host} ...</translation>
    </message>
    <message>
        <location filename="../windows/connection_window.py" line="142"/>
        <source>Connection failed, check the parameters.</source>
        <translation>Připojení selhalo, zkontrolujte parametry.</translation>
    </message>
    <message>
        <location filename="../windows/connection_window.py" line="144"/>
        <source>The CAN adapter cannot be used.</source>
        <translation>Adaptér CAN nelze použít.</translation>
    </message>
    <message>
        <location filename="../windows/connection_window.py" line="143"/>
        <source>The CAN adapter of the bus {bus} cannot be used.</source>
        <translation>Adaptér CAN sběrnice {bus} nelze použít.</translation>
    </message>
</context>
<context>
    <name>Duration</name>
    <message>
        <location filename="../i18n.py" line="60"/>
        <source>{seconds} s</source>
        <translation>{seconds} s</translation>
    </message>
    <message>
        <location filename="../i18n.py" line="63"/>
        <source>{minutes} min</source>
        <translation>{minutes} min</translation>
    </message>
    <message>
        <location filename="../i18n.py" line="64"/>
        <source>{hours} h {minutes:02d} min</source>
        <translation>{hours} h {minutes:02d} min</translation>
    </message>
</context>
<context>
    <name>Event</name>
    <message>
        <location filename="../events/event_model.py" line="90"/>
        <source>Robot&apos;s log</source>
        <translation>Záznam robotu</translation>
    </message>
    <message>
        <location filename="../events/event_model.py" line="90"/>
        <source>Fault</source>
        <translation>Porucha</translation>
    </message>
    <message>
        <location filename="../events/event_model.py" line="91"/>
        <source>Answer</source>
        <translation>Odpověď</translation>
    </message>
    <message>
        <location filename="../events/event_model.py" line="91"/>
        <source>Locks</source>
        <translation>Zámky</translation>
    </message>
    <message>
        <location filename="../events/event_model.py" line="92"/>
        <source>Test</source>
        <translation>Test</translation>
    </message>
    <message>
        <location filename="../events/event_model.py" line="92"/>
        <source>Operator</source>
        <translation>Operátor</translation>
    </message>
    <message>
        <location filename="../events/event_model.py" line="96"/>
        <source>robot</source>
        <translation>robot</translation>
    </message>
    <message>
        <location filename="../events/event_model.py" line="96"/>
        <source>Car</source>
        <translation>Auto</translation>
    </message>
    <message>
        <location filename="../events/event_model.py" line="97"/>
        <source>application</source>
        <translation>aplikace</translation>
    </message>
</context>
<context>
    <name>EventModel</name>
    <message>
        <location filename="../events/event_model.py" line="85"/>
        <source>Time</source>
        <translation>Čas</translation>
    </message>
    <message>
        <location filename="../events/event_model.py" line="85"/>
        <source>Kind</source>
        <translation>Druh</translation>
    </message>
    <message>
        <location filename="../events/event_model.py" line="85"/>
        <source>Source</source>
        <translation>Zdroj</translation>
    </message>
    <message>
        <location filename="../events/event_model.py" line="85"/>
        <source>What happened</source>
        <translation>Co se stalo</translation>
    </message>
</context>
<context>
    <name>EventWindow</name>
    <message>
        <location filename="../events/event_window.py" line="51"/>
        <source>Events</source>
        <translation>Události</translation>
    </message>
    <message>
        <location filename="../events/event_window.py" line="55"/>
        <source>Which events</source>
        <translation>Které události</translation>
    </message>
    <message>
        <location filename="../events/event_window.py" line="55"/>
        <source>Since the start</source>
        <translation>Od spuštění</translation>
    </message>
    <message>
        <location filename="../events/event_window.py" line="55"/>
        <source>Of the test</source>
        <translation>Tohoto testu</translation>
    </message>
    <message>
        <location filename="../events/event_window.py" line="57"/>
        <source>Kind</source>
        <translation>Druh</translation>
    </message>
    <message>
        <location filename="../events/event_window.py" line="57"/>
        <source>All kinds</source>
        <translation>Všechny druhy</translation>
    </message>
    <message>
        <location filename="../events/event_window.py" line="59"/>
        <source>Severity</source>
        <translation>Závažnost</translation>
    </message>
    <message>
        <location filename="../events/event_window.py" line="59"/>
        <source>All</source>
        <translation>Vše</translation>
    </message>
    <message>
        <location filename="../events/event_window.py" line="59"/>
        <source>Warnings</source>
        <translation>Varování</translation>
    </message>
    <message>
        <location filename="../events/event_window.py" line="59"/>
        <source>Errors</source>
        <translation>Chyby</translation>
    </message>
    <message>
        <location filename="../events/event_window.py" line="63"/>
        <source>Search</source>
        <translation>Hledat</translation>
    </message>
    <message>
        <location filename="../events/event_window.py" line="89"/>
        <source>Events, the newest first</source>
        <translation>Události, nejnovější první</translation>
    </message>
    <message>
        <location filename="../events/event_window.py" line="97"/>
        <source>Close</source>
        <translation>Zavřít</translation>
    </message>
    <message>
        <location filename="../events/event_window.py" line="133"/>
        <source>{count} events, {shown} of them shown.</source>
        <translation>Událostí: {count}, zobrazeno: {shown}.</translation>
    </message>
    <message>
        <location filename="../events/event_window.py" line="155"/>
        <source>No test is at hand.</source>
        <translation>Žádný test není otevřen.</translation>
    </message>
    <message>
        <location filename="../events/event_window.py" line="155"/>
        <source>They are kept in {folder}.</source>
        <translation>Jsou uloženy v {folder}.</translation>
    </message>
</context>
<context>
    <name>Figure</name>
    <message>
        <location filename="../texts/figures.py" line="5"/>
        <source>{first}</source>
        <translation>{first}</translation>
    </message>
    <message>
        <location filename="../texts/figures.py" line="5"/>
        <source>at least {first}</source>
        <translation>nejméně {first}</translation>
    </message>
    <message>
        <location filename="../texts/figures.py" line="5"/>
        <source>at most {first}</source>
        <translation>nejvýše {first}</translation>
    </message>
    <message>
        <location filename="../texts/figures.py" line="5"/>
        <source>{first} to {second}</source>
        <translation>{first} až {second}</translation>
    </message>
    <message>
        <location filename="../texts/figures.py" line="5"/>
        <source>not reached</source>
        <translation>nedosaženo</translation>
    </message>
    <message>
        <location filename="../texts/figures.py" line="5"/>
        <source>invalid</source>
        <translation>neplatné</translation>
    </message>
    <message>
        <location filename="../texts/figures.py" line="5"/>
        <source>key</source>
        <translation>klíč</translation>
    </message>
    <message>
        <location filename="../texts/figures.py" line="5"/>
        <source>unknown</source>
        <translation>neznámá</translation>
    </message>
</context>
<context>
    <name>FileField</name>
    <message>
        <location filename="../forms/file_field.py" line="35"/>
        <source>Choose</source>
        <translation>Vybrat</translation>
    </message>
    <message>
        <location filename="../forms/file_field.py" line="36"/>
        <source>Choose a file: {what}</source>
        <translation>Vybrat soubor: {what}</translation>
    </message>
    <message>
        <location filename="../forms/file_field.py" line="38"/>
        <source>Without</source>
        <translation>Bez souboru</translation>
    </message>
    <message>
        <location filename="../forms/file_field.py" line="39"/>
        <source>Without a file: {what}</source>
        <translation>Bez souboru: {what}</translation>
    </message>
</context>
<context>
    <name>Forecast</name>
    <message>
        <location filename="../forecast_text.py" line="15"/>
        <source>Attempts on each line: {count}.</source>
        <translation>Pokusů na každé přímce: {count}.</translation>
    </message>
    <message>
        <location filename="../forecast_text.py" line="21"/>
        <source>The distances will have no 95 % interval.</source>
        <translation>Vzdálenosti nebudou mít 95% interval.</translation>
    </message>
    <message>
        <location filename="../forecast_text.py" line="22"/>
        <source>Expected 95 % interval: {interval} m.</source>
        <translation>Očekávaný 95% interval: {interval} m.</translation>
    </message>
    <message>
        <location filename="../forecast_text.py" line="32"/>
        <source>{low} to {high}</source>
        <translation>{low} až {high}</translation>
    </message>
    <message>
        <location filename="../forecast_text.py" line="18"/>
        <source>Expected 95 % interval of the coverage: {interval} %.</source>
        <translation>Očekávaný 95% interval pokrytí: {interval} %.</translation>
    </message>
</context>
<context>
    <name>GivenForm</name>
    <message>
        <location filename="../forms/given_form.py" line="37"/>
        <source>Limits file</source>
        <translation>Soubor mezí</translation>
    </message>
    <message>
        <location filename="../forms/given_form.py" line="37"/>
        <source>none: no verdict</source>
        <translation>žádný: bez verdiktu</translation>
    </message>
    <message>
        <location filename="../forms/given_form.py" line="37"/>
        <source>What the distances have to be; the lines are judged by it.</source>
        <translation>Jaké vzdálenosti mají být; podle toho se přímka posoudí.</translation>
    </message>
    <message>
        <location filename="../forms/given_form.py" line="39"/>
        <source>Calibration record</source>
        <translation>Kalibrační záznam</translation>
    </message>
    <message>
        <location filename="../forms/given_form.py" line="39"/>
        <source>that of the design</source>
        <translation>konstrukční</translation>
    </message>
    <message>
        <location filename="../forms/given_form.py" line="39"/>
        <source>What is known of this robot; the uncertainties follow from it.</source>
        <translation>Co je o tomto robotu známo; plynou z toho nejistoty.</translation>
    </message>
</context>
<context>
    <name>Guide</name>
    <message>
        <location filename="../calibration/height_card.py" line="36"/>
        <source>Key height</source>
        <translation>Výška klíče</translation>
    </message>
    <message>
        <location filename="../calibration/height_card.py" line="36"/>
        <source>Send the key to a height, measure from the floor to its middle, and take the reading; at three heights or more, low ones and high ones.</source>
        <translation>Pošlete klíč do výšky, změřte od podlahy k jeho středu a odečet převezměte; ve třech nebo více výškách, nízkých i vysokých.</translation>
    </message>
    <message>
        <location filename="../calibration/height_card.py" line="43"/>
        <source>Send the key there</source>
        <translation>Poslat tam klíč</translation>
    </message>
    <message>
        <location filename="../calibration/height_card.py" line="44"/>
        <source>Tape measure</source>
        <translation>Svinovací metr</translation>
    </message>
    <message>
        <location filename="../calibration/height_card.py" line="45"/>
        <source>Take the reading</source>
        <translation>Převzít odečet</translation>
    </message>
    <message>
        <location filename="../calibration/height_card.py" line="46"/>
        <source>Forget the readings</source>
        <translation>Zapomenout odečty</translation>
    </message>
    <message>
        <location filename="../calibration/height_card.py" line="68"/>
        <source>This is not a number.</source>
        <translation>Není to číslo.</translation>
    </message>
    <message>
        <location filename="../calibration/height_card.py" line="88"/>
        <source>{tape} cm for {reported} cm</source>
        <translation>{tape} cm při hlášených {reported} cm</translation>
    </message>
    <message>
        <location filename="../calibration/height_card.py" line="91"/>
        <source>Readings: {taken}.</source>
        <translation>Odečty: {taken}.</translation>
    </message>
    <message>
        <location filename="../calibration/height_card.py" line="100"/>
        <source>The key is {offset} mm higher than the robot reports ({sigma} mm, 1 sigma).</source>
        <translation>Klíč je o {offset} mm výš, než robot hlásí ({sigma} mm, 1 sigma).</translation>
    </message>
    <message>
        <location filename="../calibration/lever_card.py" line="23"/>
        <source>Key&apos;s lever</source>
        <translation>Rameno klíče</translation>
    </message>
    <message>
        <location filename="../calibration/lever_card.py" line="23"/>
        <source>Let a plumb line down from the key. Along the robot, read how far it hangs ahead of the front axle&apos;s hub, and of the rear axle&apos;s; three times or more, with a new look at each.</source>
        <translation>Spusťte od klíče olovnici. Podél robotu odečtěte, jak daleko visí před nábojem přední nápravy a před nábojem zadní; třikrát nebo vícekrát, pokaždé znovu.</translation>
    </message>
    <message>
        <location filename="../calibration/lever_card.py" line="28"/>
        <source>Readings with a blank between them; negative behind the axle.</source>
        <translation>Odečty oddělené mezerou; za nápravou záporné.</translation>
    </message>
    <message>
        <location filename="../calibration/lever_card.py" line="29"/>
        <source>Key ahead of the front axle</source>
        <translation>Klíč před přední nápravou</translation>
    </message>
    <message>
        <location filename="../calibration/lever_card.py" line="30"/>
        <source>Key ahead of the rear axle</source>
        <translation>Klíč před zadní nápravou</translation>
    </message>
    <message>
        <location filename="../calibration/lever_card.py" line="45"/>
        <source>These are not numbers with a blank between them.</source>
        <translation>Nejsou to čísla oddělená mezerou.</translation>
    </message>
    <message>
        <location filename="../calibration/lever_card.py" line="56"/>
        <source>The key is {lever} cm ahead of the robot&apos;s middle ({sigma} mm, 1 sigma); the robot computes with {stated} cm.</source>
        <translation>Klíč je {lever} cm před středem robotu ({sigma} mm, 1 sigma); robot počítá s {stated} cm.</translation>
    </message>
    <message>
        <location filename="../calibration/lever_card.py" line="60"/>
        <source>What lies between counts in full until the robot&apos;s description is put right.</source>
        <translation>Rozdíl se započítává celý, dokud se popis robotu neopraví.</translation>
    </message>
    <message>
        <location filename="../calibration/press_card.py" line="28"/>
        <source>Press strength</source>
        <translation>Síla stisku</translation>
    </message>
    <message>
        <location filename="../calibration/press_card.py" line="28"/>
        <source>Have the robot stand where the Car hears its key well. The key&apos;s buttons are pressed, weakly first, until the Car answers {count} times in a row.</source>
        <translation>Nechte robot stát tam, kde auto klíč dobře slyší. Tlačítka klíče se tisknou, nejprve slabě, dokud auto neodpoví {count}krát po sobě.</translation>
    </message>
    <message>
        <location filename="../calibration/press_card.py" line="33"/>
        <source>Find the strength</source>
        <translation>Najít sílu</translation>
    </message>
    <message>
        <location filename="../calibration/press_card.py" line="62"/>
        <source>The Car answers each time from a strength of {strength} on ({presses} presses).</source>
        <translation>Auto odpovídá pokaždé od síly {strength} (počet stisků: {presses}).</translation>
    </message>
    <message>
        <location filename="../calibration/press_card.py" line="67"/>
        <source>Press {presses}, with a strength of {strength}.</source>
        <translation>Stisk {presses}, silou {strength}.</translation>
    </message>
    <message>
        <location filename="../calibration/press_card.py" line="67"/>
        <source>The Car does not answer even to full strength: go nearer, and check the key&apos;s battery and its seat.</source>
        <translation>Auto neodpovídá ani na plnou sílu: zajeďte blíž a zkontrolujte baterii a uložení klíče.</translation>
    </message>
    <message>
        <location filename="../calibration/press_card.py" line="67"/>
        <source>Whether the Car is locked is not known; choose its CAN adapter under Settings, and wake the Car.</source>
        <translation>Zda je auto zamčené, není známo; v Nastavení zvolte jeho adaptér CAN a auto probuďte.</translation>
    </message>
    <message>
        <location filename="../calibration/press_card.py" line="67"/>
        <source>The robot does not say that it has pressed; see its notifications.</source>
        <translation>Robot nehlásí, že stiskl; podívejte se na jeho oznámení.</translation>
    </message>
    <message>
        <location filename="../calibration/press_card.py" line="67"/>
        <source>Stopped.</source>
        <translation>Zastaveno.</translation>
    </message>
    <message>
        <location filename="../calibration/step_card.py" line="36"/>
        <source>Keep in the record</source>
        <translation>Uchovat v záznamu</translation>
    </message>
    <message>
        <location filename="../calibration/step_card.py" line="37"/>
        <source>Keep in the record: {what}</source>
        <translation>Uchovat v záznamu: {what}</translation>
    </message>
</context>
<context>
    <name>GuideWindow</name>
    <message>
        <location filename="../calibration/guide_window.py" line="38"/>
        <source>Guided calibration</source>
        <translation>Kalibrace krok za krokem</translation>
    </message>
    <message>
        <location filename="../calibration/guide_window.py" line="41"/>
        <source>Calibration record</source>
        <translation>Kalibrační záznam</translation>
    </message>
    <message>
        <location filename="../calibration/guide_window.py" line="41"/>
        <source>a new one</source>
        <translation>nový</translation>
    </message>
    <message>
        <location filename="../calibration/guide_window.py" line="41"/>
        <source>What is known of this robot; the uncertainties follow from it.</source>
        <translation>Co je o tomto robotu známo; plynou z toho nejistoty.</translation>
    </message>
    <message>
        <location filename="../calibration/guide_window.py" line="43"/>
        <source>Robot</source>
        <translation>Robot</translation>
    </message>
    <message>
        <location filename="../calibration/guide_window.py" line="43"/>
        <source>Its name or number; the record is kept under it.</source>
        <translation>Jeho jméno nebo číslo; záznam se uchová pod ním.</translation>
    </message>
    <message>
        <location filename="../calibration/guide_window.py" line="44"/>
        <source>Measured by</source>
        <translation>Měřil</translation>
    </message>
    <message>
        <location filename="../calibration/guide_window.py" line="57"/>
        <source>Record</source>
        <translation>Záznam</translation>
    </message>
    <message>
        <location filename="../calibration/guide_window.py" line="65"/>
        <source>Close</source>
        <translation>Zavřít</translation>
    </message>
    <message>
        <location filename="../calibration/guide_window.py" line="135"/>
        <source>Enter it before something is kept.</source>
        <translation>Vyplňte, než se něco uchová.</translation>
    </message>
    <message>
        <location filename="../calibration/guide_window.py" line="150"/>
        <source>Kept in {path}; the next tests use it.</source>
        <translation>Uchováno v {path}; další testy to použijí.</translation>
    </message>
</context>
<context>
    <name>HeaderBar</name>
    <message>
        <location filename="../header/header_bar.py" line="42"/>
        <source>Welcome</source>
        <translation>Úvod</translation>
    </message>
    <message>
        <location filename="../header/header_bar.py" line="42"/>
        <source>Measurement type</source>
        <translation>Typ měření</translation>
    </message>
    <message>
        <location filename="../header/header_bar.py" line="42"/>
        <source>Measurement</source>
        <translation>Měření</translation>
    </message>
    <message>
        <location filename="../header/header_bar.py" line="42"/>
        <source>Protocol</source>
        <translation>Protokol</translation>
    </message>
    <message>
        <location filename="../header/header_bar.py" line="59"/>
        <source>The link is not encrypted: whoever is in its network can move the robot.</source>
        <translation>Spojení není šifrované: kdokoli v jeho síti může s robotem pohnout.</translation>
    </message>
    <message>
        <location filename="../header/header_bar.py" line="57"/>
        <source>Another application controls the robot: Stop in this window does not reach it. Stop it there, or by the emergency stop.</source>
        <translation>Robota řídí jiná aplikace: zastavení z tohoto okna k němu nedojde. Zastavte ho v ní, nebo nouzovým zastavením.</translation>
    </message>
</context>
<context>
    <name>HistoryFilters</name>
    <message>
        <location filename="../history/history_filters.py" line="30"/>
        <source>Search: VIN, key, day, operator, note</source>
        <translation>Hledat: VIN, klíč, den, operátor, poznámka</translation>
    </message>
    <message>
        <location filename="../history/history_filters.py" line="31"/>
        <source>Search</source>
        <translation>Hledat</translation>
    </message>
    <message>
        <location filename="../history/history_filters.py" line="33"/>
        <source>Car</source>
        <translation>Auto</translation>
    </message>
    <message>
        <location filename="../history/history_filters.py" line="34"/>
        <source>Key</source>
        <translation>Klíč</translation>
    </message>
    <message>
        <location filename="../history/history_filters.py" line="35"/>
        <source>Verdict</source>
        <translation>Verdikt</translation>
    </message>
</context>
<context>
    <name>HistoryModel</name>
    <message>
        <location filename="../history/history_model.py" line="50"/>
        <source>Begun</source>
        <translation>Začátek</translation>
    </message>
    <message>
        <location filename="../history/history_model.py" line="50"/>
        <source>Scenario</source>
        <translation>Scénář</translation>
    </message>
    <message>
        <location filename="../history/history_model.py" line="50"/>
        <source>Lines</source>
        <translation>Přímky</translation>
    </message>
    <message>
        <location filename="../history/history_model.py" line="50"/>
        <source>Verdict</source>
        <translation>Verdikt</translation>
    </message>
    <message>
        <location filename="../history/history_model.py" line="50"/>
        <source>Car</source>
        <translation>Auto</translation>
    </message>
    <message>
        <location filename="../history/history_model.py" line="50"/>
        <source>Key</source>
        <translation>Klíč</translation>
    </message>
    <message>
        <location filename="../history/history_model.py" line="50"/>
        <source>Operator</source>
        <translation>Operátor</translation>
    </message>
    <message>
        <location filename="../history/history_model.py" line="50"/>
        <source>Place</source>
        <translation>Místo</translation>
    </message>
    <message>
        <location filename="../history/history_model.py" line="55"/>
        <source>cannot be read</source>
        <translation>nelze přečíst</translation>
    </message>
    <message>
        <location filename="../history/history_model.py" line="43"/>
        <source>In the store {where}, as test {number}</source>
        <translation>V úložišti {where} jako test {number}</translation>
    </message>
</context>
<context>
    <name>HistoryScreen</name>
    <message>
        <location filename="../history/history_screen.py" line="247"/>
        <source>Open</source>
        <translation>Otevřít</translation>
    </message>
    <message>
        <location filename="../history/history_screen.py" line="82"/>
        <source>Repeat</source>
        <translation>Opakovat</translation>
    </message>
    <message>
        <location filename="../history/history_screen.py" line="83"/>
        <source>A new test with the same parameters, car and key</source>
        <translation>Nový test se stejnými parametry, autem a klíčem</translation>
    </message>
    <message>
        <location filename="../history/history_screen.py" line="84"/>
        <source>Compare two</source>
        <translation>Porovnat dva</translation>
    </message>
    <message>
        <location filename="../history/history_screen.py" line="88"/>
        <source>Open a file</source>
        <translation>Otevřít soubor</translation>
    </message>
    <message>
        <location filename="../history/history_screen.py" line="94"/>
        <source>Back</source>
        <translation>Zpět</translation>
    </message>
    <message>
        <location filename="../history/history_screen.py" line="99"/>
        <source>Tests; choose one to open it, or two to compare them</source>
        <translation>Testy; vyberte jeden k otevření, nebo dva k porovnání</translation>
    </message>
    <message>
        <location filename="../history/history_screen.py" line="116"/>
        <source>Tests so far</source>
        <translation>Dosavadní testy</translation>
    </message>
    <message>
        <location filename="../history/history_screen.py" line="145"/>
        <source>The folders are being read.</source>
        <translation>Složky se čtou.</translation>
    </message>
    <message>
        <location filename="../history/history_screen.py" line="215"/>
        <source>{count} tests, {shown} of them shown.</source>
        <translation>Testů: {count}, zobrazeno: {shown}.</translation>
    </message>
    <message>
        <location filename="../history/history_screen.py" line="222"/>
        <source>{count} more files cannot be read.</source>
        <translation>Dalších {count} souborů nelze přečíst.</translation>
    </message>
    <message>
        <location filename="../history/history_screen.py" line="247"/>
        <source>Continue</source>
        <translation>Pokračovat</translation>
    </message>
    <message>
        <location filename="../history/history_screen.py" line="251"/>
        <source>This test is in a signed bundle: it can be repeated and compared. Unpack the bundle into a folder of its own to open it.</source>
        <translation>Tento test je v podepsaném balíčku: lze jej opakovat a porovnat. Pro otevření balíček rozbalte do vlastní složky.</translation>
    </message>
    <message>
        <location filename="../history/history_screen.py" line="89"/>
        <source>Verify a bundle</source>
        <translation>Ověřit balíček</translation>
    </message>
    <message>
        <location filename="../history/history_screen.py" line="90"/>
        <source>Whether a bundle of evidence is as it was signed, by whom and when</source>
        <translation>Zda je balíček důkazů tak, jak byl podepsán, kým a kdy</translation>
    </message>
    <message>
        <location filename="../history/history_screen.py" line="167"/>
        <source>Bundle of evidence</source>
        <translation>Balíček důkazů</translation>
    </message>
    <message>
        <location filename="../history/history_screen.py" line="174"/>
        <source>{name} is being verified.</source>
        <translation>{name} se ověřuje.</translation>
    </message>
    <message>
        <location filename="../history/history_screen.py" line="91"/>
        <source>Compute anew</source>
        <translation>Přepočítat</translation>
    </message>
    <message>
        <location filename="../history/history_screen.py" line="92"/>
        <source>What would change in this test with the car profile as it is now, from its recorded log and poses</source>
        <translation>Co by se v tomto testu změnilo s nynějším profilem auta, podle zaznamenaného logu a poloh</translation>
    </message>
    <message>
        <location filename="../history/history_screen.py" line="272"/>
        <source>{name} is being computed anew.</source>
        <translation>{name} se přepočítává.</translation>
    </message>
    <message>
        <location filename="../history/history_screen.py" line="85"/>
        <source>Spread</source>
        <translation>Rozptyl</translation>
    </message>
    <message>
        <location filename="../history/history_screen.py" line="86"/>
        <source>Mean and standard deviation of each distance: of the tests chosen, or of all tests of the car and key of one test with its parameters</source>
        <translation>Průměr a směrodatná odchylka každé vzdálenosti: z vybraných testů, nebo ze všech testů auta a klíče jednoho testu s jeho parametry</translation>
    </message>
    <message>
        <location filename="../history/history_screen.py" line="287"/>
        <source>No other test has the parameters, the car and the key of this one.</source>
        <translation>Žádný jiný test nemá parametry, auto a klíč tohoto testu.</translation>
    </message>
    <message>
        <location filename="../history/history_screen.py" line="292"/>
        <source>{count} tests are being read.</source>
        <translation>Čte se {count} testů.</translation>
    </message>
    <message>
        <location filename="../history/history_screen.py" line="219"/>
        <source>In the store {where} alone: {count}; what is opened is copied from there.</source>
        <translation>Jen v úložišti {where}: {count}; co se otevře, zkopíruje se odtud.</translation>
    </message>
</context>
<context>
    <name>HoldButton</name>
    <message>
        <location filename="../forms/hold_button.py" line="32"/>
        <source>Hold it for {time} s, with the mouse, Space or Enter: so you confirm that nobody and nothing is in the robot&apos;s way.</source>
        <translation>Podržte {time} s myší, mezerníkem nebo klávesou Enter: tím potvrzujete, že robotu nikdo a nic nestojí v cestě.</translation>
    </message>
</context>
<context>
    <name>HoldRelease</name>
    <message>
        <location filename="../forms/hold_release.py" line="24"/>
        <source>Hold to go on</source>
        <translation>Podržením jet dál</translation>
    </message>
</context>
<context>
    <name>Identity</name>
    <message>
        <location filename="../texts/identity.py" line="5"/>
        <source>Car&apos;s VIN</source>
        <translation>VIN auta</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="5"/>
        <source>Car&apos;s model</source>
        <translation>Model auta</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="5"/>
        <source>Car&apos;s software</source>
        <translation>Software auta</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="5"/>
        <source>Key&apos;s serial number</source>
        <translation>Výrobní číslo klíče</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="5"/>
        <source>Key&apos;s type</source>
        <translation>Typ klíče</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="5"/>
        <source>Key&apos;s battery</source>
        <translation>Baterie klíče</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="5"/>
        <source>Operator</source>
        <translation>Operátor</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="5"/>
        <source>Place</source>
        <translation>Místo</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="5"/>
        <source>Weather</source>
        <translation>Počasí</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="5"/>
        <source>Notes</source>
        <translation>Poznámky</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="5"/>
        <source>Equipment</source>
        <translation>Měřidla</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="5"/>
        <source>Photos</source>
        <translation>Fotografie</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="5"/>
        <source>Person in charge</source>
        <translation>Odpovědná osoba</translation>
    </message>
</context>
<context>
    <name>IdentityForm</name>
    <message>
        <location filename="../forms/identity_form.py" line="48"/>
        <source>One a line: name; serial number; calibrated; valid until</source>
        <translation>Jedno na řádek: název; výrobní číslo; kalibrováno; platí do</translation>
    </message>
    <message>
        <location filename="../forms/identity_form.py" line="158"/>
        <source>Nothing is said of car, key and operator.</source>
        <translation>O autu, klíči a operátorovi není nic zadáno.</translation>
    </message>
    <message>
        <location filename="../forms/identity_form.py" line="169"/>
        <source>The laboratory requires: {names}.</source>
        <translation>Laboratoř vyžaduje: {names}.</translation>
    </message>
    <message>
        <location filename="../forms/identity_form.py" line="175"/>
        <source>Car, key and operator</source>
        <translation>Auto, klíč a operátor</translation>
    </message>
</context>
<context>
    <name>LanguageBox</name>
    <message>
        <location filename="../forms/language_box.py" line="18"/>
        <source>As the system</source>
        <translation>Podle systému</translation>
    </message>
    <message>
        <location filename="../forms/language_box.py" line="22"/>
        <source>Language</source>
        <translation>Jazyk</translation>
    </message>
</context>
<context>
    <name>LearnWindow</name>
    <message>
        <location filename="../learn/learn_window.py" line="61"/>
        <source>Learn a Car</source>
        <translation>Naučit auto</translation>
    </message>
    <message>
        <location filename="../learn/learn_window.py" line="129"/>
        <source>Begin</source>
        <translation>Začít</translation>
    </message>
    <message>
        <location filename="../learn/learn_window.py" line="75"/>
        <source>Prompts that are answered</source>
        <translation>Zodpovězené výzvy</translation>
    </message>
    <message>
        <location filename="../learn/learn_window.py" line="78"/>
        <source>Name of the Car</source>
        <translation>Název auta</translation>
    </message>
    <message>
        <location filename="../learn/learn_window.py" line="78"/>
        <source>Letters, digits, - and _; the profile is kept under it.</source>
        <translation>Písmena, číslice, - a _; profil se pod ním uchová.</translation>
    </message>
    <message>
        <location filename="../learn/learn_window.py" line="82"/>
        <source>Keep the profile</source>
        <translation>Uchovat profil</translation>
    </message>
    <message>
        <location filename="../learn/learn_window.py" line="92"/>
        <source>What followed the locks</source>
        <translation>Co odpovídalo zámkům</translation>
    </message>
    <message>
        <location filename="../learn/learn_window.py" line="102"/>
        <source>Close</source>
        <translation>Zavřít</translation>
    </message>
    <message>
        <location filename="../learn/learn_window.py" line="127"/>
        <source>You lock and unlock the Car with its own key {count} times, when you are asked; meanwhile its bus is listened to. Nothing is sent.</source>
        <translation>Na výzvu auto {count}krát zamknete a odemknete jeho vlastním klíčem; přitom se naslouchá jeho sběrnici. Nic se neposílá.</translation>
    </message>
    <message>
        <location filename="../learn/learn_window.py" line="141"/>
        <source>The adapter is opened.</source>
        <translation>Otevírá se adaptér.</translation>
    </message>
    <message>
        <location filename="../learn/learn_window.py" line="174"/>
        <source>{count} frames so far.</source>
        <translation>Zatím rámců: {count}.</translation>
    </message>
    <message>
        <location filename="../learn/learn_window.py" line="180"/>
        <source>It is done</source>
        <translation>Hotovo</translation>
    </message>
    <message>
        <location filename="../learn/learn_window.py" line="181"/>
        <source>{number} of {count}: lock the Car with its own key.</source>
        <translation>{number} z {count}: zamkněte auto jeho vlastním klíčem.</translation>
    </message>
    <message>
        <location filename="../learn/learn_window.py" line="182"/>
        <source>{number} of {count}: unlock the Car, all doors.</source>
        <translation>{number} z {count}: odemkněte auto, všechny dveře.</translation>
    </message>
    <message>
        <location filename="../learn/learn_window.py" line="183"/>
        <source>Leave the Car alone for a moment.</source>
        <translation>Nechte auto chvíli v klidu.</translation>
    </message>
    <message>
        <location filename="../learn/learn_window.py" line="194"/>
        <source>The recording is looked through.</source>
        <translation>Prohlíží se záznam.</translation>
    </message>
    <message>
        <location filename="../learn/learn_window.py" line="209"/>
        <source>The message {id} tells the locks.</source>
        <translation>O zámcích vypovídá zpráva {id}.</translation>
    </message>
    <message>
        <location filename="../learn/learn_window.py" line="247"/>
        <source>Kept in {path}.</source>
        <translation>Uchováno v {path}.</translation>
    </message>
    <message>
        <location filename="../learn/learn_window.py" line="80"/>
        <source>CAN database of the Car</source>
        <translation>Databáze CAN auta</translation>
    </message>
    <message>
        <location filename="../learn/learn_window.py" line="80"/>
        <source>none: the profile gets one of its own</source>
        <translation>žádná: profil dostane vlastní</translation>
    </message>
    <message>
        <location filename="../learn/learn_window.py" line="80"/>
        <source>Names the message and the signal.</source>
        <translation>Pojmenuje zprávu a signál.</translation>
    </message>
</context>
<context>
    <name>LinkSymbol</name>
    <message>
        <location filename="../header/symbols.py" line="141"/>
        <source>The link to the robot is encrypted.</source>
        <translation>Spojení s robotem je šifrované.</translation>
    </message>
    <message>
        <location filename="../header/symbols.py" line="143"/>
        <source>The link to the robot is not encrypted.</source>
        <translation>Spojení s robotem není šifrované.</translation>
    </message>
    <message>
        <location filename="../header/symbols.py" line="142"/>
        <source>The link is not encrypted: whoever is in its network can move the robot.</source>
        <translation>Spojení není šifrované: kdokoli v jeho síti může s robotem pohnout.</translation>
    </message>
</context>
<context>
    <name>Locks</name>
    <message>
        <location filename="../names.py" line="66"/>
        <source>locked</source>
        <translation>zamčeno</translation>
    </message>
    <message>
        <location filename="../names.py" line="66"/>
        <source>unlocked</source>
        <translation>odemčeno</translation>
    </message>
    <message>
        <location filename="../names.py" line="67"/>
        <source>not known</source>
        <translation>není známo</translation>
    </message>
</context>
<context>
    <name>LocksSymbol</name>
    <message>
        <location filename="../header/symbols.py" line="93"/>
        <source>The Car is locked.</source>
        <translation>Auto je zamčené.</translation>
    </message>
    <message>
        <location filename="../header/symbols.py" line="93"/>
        <source>The Car is unlocked.</source>
        <translation>Auto je odemčené.</translation>
    </message>
    <message>
        <location filename="../header/symbols.py" line="94"/>
        <source>Whether the Car is locked is not known.</source>
        <translation>Zda je auto zamčené, není známo.</translation>
    </message>
    <message>
        <location filename="../header/symbols.py" line="96"/>
        <source>A click opens the live bus view.</source>
        <translation>Kliknutím se otevře živý pohled na sběrnici.</translation>
    </message>
</context>
<context>
    <name>MainWindow</name>
    <message>
        <location filename="../windows/main_window.py" line="67"/>
        <source>Mobile testing robot</source>
        <translation>Mobilní testovací robot</translation>
    </message>
    <message>
        <location filename="../windows/main_window.py" line="259"/>
        <source>Saved to {path}</source>
        <translation>Uloženo do {path}</translation>
    </message>
    <message>
        <location filename="../windows/main_window.py" line="262"/>
        <source>Choose another folder; nothing is lost.</source>
        <translation>Vyberte jinou složku; nic se neztratilo.</translation>
    </message>
    <message>
        <location filename="../windows/main_window.py" line="264"/>
        <source>Folder for the progress of tests</source>
        <translation>Složka pro průběh testů</translation>
    </message>
    <message>
        <location filename="../windows/main_window.py" line="279"/>
        <source>The robot is stopped, and the test paused. Close the application? What is measured is kept; the next start offers to go on.</source>
        <translation>Robot je zastaven a test pozastaven. Zavřít aplikaci? Co je změřeno, zůstane uloženo; při příštím spuštění lze pokračovat.</translation>
    </message>
    <message>
        <location filename="../windows/main_window.py" line="283"/>
        <source>Close</source>
        <translation>Zavřít</translation>
    </message>
    <message>
        <location filename="../windows/main_window.py" line="283"/>
        <source>Stay</source>
        <translation>Zůstat</translation>
    </message>
    <message>
        <location filename="../windows/main_window.py" line="244"/>
        <source>Open a test</source>
        <translation>Otevřít test</translation>
    </message>
</context>
<context>
    <name>MeasurementFacts</name>
    <message>
        <location filename="../screens/measurement_facts.py" line="43"/>
        <source>Progress of the test</source>
        <translation>Průběh testu</translation>
    </message>
    <message>
        <location filename="../screens/measurement_facts.py" line="48"/>
        <source>Car</source>
        <translation>Auto</translation>
    </message>
    <message>
        <location filename="../screens/measurement_facts.py" line="48"/>
        <source>Locks</source>
        <translation>Zámky</translation>
    </message>
    <message>
        <location filename="../screens/measurement_facts.py" line="48"/>
        <source>Key height</source>
        <translation>Výška klíče</translation>
    </message>
    <message>
        <location filename="../screens/measurement_facts.py" line="49"/>
        <source>Speed</source>
        <translation>Rychlost</translation>
    </message>
    <message>
        <location filename="../screens/measurement_facts.py" line="49"/>
        <source>Position</source>
        <translation>Poloha</translation>
    </message>
    <message>
        <location filename="../screens/measurement_facts.py" line="49"/>
        <source>Last result</source>
        <translation>Poslední výsledek</translation>
    </message>
    <message>
        <location filename="../screens/measurement_facts.py" line="81"/>
        <source>{done} of {total} lines measured</source>
        <translation>změřeno {done} z {total} přímek</translation>
    </message>
    <message>
        <location filename="../screens/measurement_facts.py" line="114"/>
        <source>not known</source>
        <translation>není známa</translation>
    </message>
    <message>
        <location filename="../screens/measurement_facts.py" line="121"/>
        <source>about {time} left</source>
        <translation>zbývá asi {time}</translation>
    </message>
    <message>
        <location filename="../screens/measurement_facts.py" line="127"/>
        <source>The robot is being stopped.</source>
        <translation>Robot se zastavuje.</translation>
    </message>
    <message>
        <location filename="../screens/measurement_facts.py" line="129"/>
        <source>Paused. The line at hand is measured anew after Resume.</source>
        <translation>Pozastaveno. Rozpracovaná přímka se po pokračování změří znovu.</translation>
    </message>
    <message>
        <location filename="../screens/measurement_facts.py" line="50"/>
        <source>Verdict so far</source>
        <translation>Zatím verdikt</translation>
    </message>
    <message>
        <location filename="../screens/measurement_facts.py" line="97"/>
        <source>The values below are {age} s old.</source>
        <translation>Údaje níže jsou {age} s staré.</translation>
    </message>
    <message>
        <location filename="../screens/measurement_facts.py" line="131"/>
        <source>Waits until the robot is heard again.</source>
        <translation>Čeká se, až bude robot zase slyšet.</translation>
    </message>
</context>
<context>
    <name>MeasurementScreen</name>
    <message>
        <location filename="../screens/measurement.py" line="93"/>
        <source>Save progress</source>
        <translation>Uložit průběh</translation>
    </message>
    <message>
        <location filename="../screens/measurement.py" line="95"/>
        <source>Back to the beginning</source>
        <translation>Zpět na začátek</translation>
    </message>
    <message>
        <location filename="../screens/measurement.py" line="199"/>
        <source>Handle taken</source>
        <translation>Klika uchopena</translation>
    </message>
    <message>
        <location filename="../screens/measurement.py" line="212"/>
        <source>Take the Car&apos;s handle now, with the Remote key at {distance} m, and then say so here, by Enter or the button. When the Car unlocks, nothing more is to be done.</source>
        <translation>Uchopte nyní kliku auta, klíč je ve vzdálenosti {distance} m, a pak to zde potvrďte klávesou Enter nebo tlačítkem. Když se auto odemkne, není třeba nic dalšího.</translation>
    </message>
    <message>
        <location filename="../screens/measurement.py" line="83"/>
        <source>Hold to resume</source>
        <translation>Podržením pokračovat</translation>
    </message>
    <message>
        <location filename="../screens/measurement.py" line="94"/>
        <source>Events</source>
        <translation>Události</translation>
    </message>
    <message>
        <location filename="../screens/measurement.py" line="199"/>
        <source>Extender switched</source>
        <translation>Extender přepnut</translation>
    </message>
    <message>
        <location filename="../screens/measurement.py" line="217"/>
        <source>Switch the extender on now, and then say so here, by Enter or the button.</source>
        <translation>Zapněte nyní extender a pak to zde potvrďte klávesou Enter nebo tlačítkem.</translation>
    </message>
    <message>
        <location filename="../screens/measurement.py" line="218"/>
        <source>Switch the extender off now, and then say so here, by Enter or the button.</source>
        <translation>Vypněte nyní extender a pak to zde potvrďte klávesou Enter nebo tlačítkem.</translation>
    </message>
    <message>
        <location filename="../screens/measurement.py" line="85"/>
        <source>Leave the line that is being measured and go on with the next one (Ctrl+K); it can be measured again when the test is done</source>
        <translation>Opustit přímku, která se právě měří, a pokračovat další (Ctrl+K); po skončení testu ji lze změřit znovu</translation>
    </message>
    <message>
        <location filename="../screens/measurement.py" line="187"/>
        <source>Skip line {number}</source>
        <translation>Přeskočit přímku {number}</translation>
    </message>
    <message>
        <location filename="../screens/measurement.py" line="187"/>
        <source>Skip the line</source>
        <translation>Přeskočit přímku</translation>
    </message>
    <message>
        <location filename="../screens/measurement.py" line="79"/>
        <source>Who resumes is present, in sight of the robot, and confirms that the operating conditions hold.</source>
        <translation>Kdo pokračuje, je přítomen, má robot na dohled a potvrzuje, že provozní podmínky platí.</translation>
    </message>
</context>
<context>
    <name>MeasurementTypeScreen</name>
    <message>
        <location filename="../screens/measurement_type.py" line="29"/>
        <source>What is to be measured?</source>
        <translation>Co se má měřit?</translation>
    </message>
    <message>
        <location filename="../screens/measurement_type.py" line="43"/>
        <source>Back</source>
        <translation>Zpět</translation>
    </message>
</context>
<context>
    <name>MessageModel</name>
    <message>
        <location filename="../bus/message_model.py" line="58"/>
        <source>Identifier</source>
        <translation>Identifikátor</translation>
    </message>
    <message>
        <location filename="../bus/message_model.py" line="58"/>
        <source>Message</source>
        <translation>Zpráva</translation>
    </message>
    <message>
        <location filename="../bus/message_model.py" line="58"/>
        <source>Frames</source>
        <translation>Rámce</translation>
    </message>
    <message>
        <location filename="../bus/message_model.py" line="58"/>
        <source>Cycle [ms]</source>
        <translation>Perioda [ms]</translation>
    </message>
    <message>
        <location filename="../bus/message_model.py" line="58"/>
        <source>Age [s]</source>
        <translation>Stáří [s]</translation>
    </message>
    <message>
        <location filename="../bus/message_model.py" line="58"/>
        <source>Newest data</source>
        <translation>Nejnovější data</translation>
    </message>
</context>
<context>
    <name>PairingForm</name>
    <message>
        <location filename="../forms/pairing_form.py" line="24"/>
        <source>Pairing code</source>
        <translation>Párovací kód</translation>
    </message>
    <message>
        <location filename="../forms/pairing_form.py" line="24"/>
        <source>once: the 6 digits that the robot shows for it</source>
        <translation>jednou: 6 číslic, které k tomu robot zobrazí</translation>
    </message>
    <message>
        <location filename="../forms/pairing_form.py" line="25"/>
        <source>Pair</source>
        <translation>Spárovat</translation>
    </message>
    <message>
        <location filename="../forms/pairing_form.py" line="30"/>
        <source>Without encryption</source>
        <translation>Bez šifrování</translation>
    </message>
    <message>
        <location filename="../forms/pairing_form.py" line="31"/>
        <source>Whoever is in the robot&apos;s network can read the link and move the robot. The robot has to allow it too.</source>
        <translation>Kdokoli v síti robotu může spojení číst a s robotem pohnout. Robot to musí také povolit.</translation>
    </message>
    <message>
        <location filename="../forms/pairing_form.py" line="68"/>
        <source>Pairing with {host} ...</source>
        <translation>Párování s {host} ...</translation>
    </message>
    <message>
        <location filename="../forms/pairing_form.py" line="74"/>
        <source>Paired: this laptop may look at the robot.</source>
        <translation>Spárováno: tento notebook smí robot sledovat.</translation>
    </message>
    <message>
        <location filename="../forms/pairing_form.py" line="74"/>
        <source>Paired: this laptop may control the robot.</source>
        <translation>Spárováno: tento notebook smí robot řídit.</translation>
    </message>
</context>
<context>
    <name>Parameter</name>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Minimum distance</source>
        <translation>Nejmenší vzdálenost</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Starting distance</source>
        <translation>Počáteční vzdálenost</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Straightening distance</source>
        <translation>Srovnávací vzdálenost</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Measurements distance</source>
        <translation>Rozteč měření</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Approach distance</source>
        <translation>Krok přiblížení</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Degrees between radials</source>
        <translation>Stupně mezi paprsky</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Maximum speed</source>
        <translation>Nejvyšší rychlost</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Measuring speed</source>
        <translation>Rychlost měření</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Clearance</source>
        <translation>Odstup</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Response time</source>
        <translation>Doba odezvy</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Locking time</source>
        <translation>Doba zamčení</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Press strength</source>
        <translation>Síla stisku</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Press duration</source>
        <translation>Délka stisku</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Standstill before a press</source>
        <translation>Klid před stiskem</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Attempts</source>
        <translation>Počet pokusů</translation>
    </message>
    <message>
        <location filename="../names.py" line="21"/>
        <source>Check the Car&apos;s position before the test</source>
        <translation>Před testem ověřit polohu auta</translation>
    </message>
    <message>
        <location filename="../names.py" line="46"/>
        <source>yes</source>
        <translation>ano</translation>
    </message>
    <message>
        <location filename="../names.py" line="46"/>
        <source>no</source>
        <translation>ne</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Distance beside the line</source>
        <translation>Odchylka od osy</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Turn from the line</source>
        <translation>Natočení od osy</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Difference in height</source>
        <translation>Odchylka výšky</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Difference in speed</source>
        <translation>Odchylka rychlosti</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Passes</source>
        <translation>Průjezdy</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Speeds of the passes</source>
        <translation>Rychlosti průjezdů</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Sigma of the boundary</source>
        <translation>Sigma hranice</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Step of a last approach</source>
        <translation>Krok posledního přiblížení</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Interval wanted, half width</source>
        <translation>Požadovaný interval, polovina šířky</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Presses at most</source>
        <translation>Nejvýše stisků</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Key&apos;s radio frequency</source>
        <translation>Rádiová frekvence klíče</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Key&apos;s rest at most</source>
        <translation>Klid klíče nejvýše</translation>
    </message>
    <message>
        <location filename="../names.py" line="27"/>
        <source>Method</source>
        <translation>Metoda</translation>
    </message>
    <message>
        <location filename="../names.py" line="35"/>
        <source>from far to near (scan)</source>
        <translation>z dálky k autu (scan)</translation>
    </message>
    <message>
        <location filename="../names.py" line="36"/>
        <source>search with intervals (adaptive)</source>
        <translation>hledání s intervaly (adaptive)</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Presses that confirm</source>
        <translation>Potvrzujících stisků</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Nominal border</source>
        <translation>Jmenovitá hranice</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Requests at the border</source>
        <translation>Žádosti na hranici</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Time for the Operator</source>
        <translation>Doba pro obsluhu</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Heights</source>
        <translation>Počet výšek</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Half a wavelength</source>
        <translation>Polovina vlnové délky</translation>
    </message>
    <message>
        <location filename="../names.py" line="27"/>
        <source>Side of the Car</source>
        <translation>Strana auta</translation>
    </message>
    <message>
        <location filename="../names.py" line="28"/>
        <source>Locking the Car again</source>
        <translation>Opětovné zamčení auta</translation>
    </message>
    <message>
        <location filename="../names.py" line="37"/>
        <source>all around</source>
        <translation>kolem celého auta</translation>
    </message>
    <message>
        <location filename="../names.py" line="37"/>
        <source>by the key&apos;s button</source>
        <translation>tlačítkem klíče</translation>
    </message>
    <message>
        <location filename="../names.py" line="38"/>
        <source>the Car by itself</source>
        <translation>auto samo</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Key height</source>
        <translation>Výška klíče</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Highest key height</source>
        <translation>Největší výška klíče</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Distance between places</source>
        <translation>Vzdálenost mezi místy</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Coverage wanted, half width</source>
        <translation>Interval pokrytí, polovina šířky</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Presses in a zone at most</source>
        <translation>Stisků v zóně nejvýše</translation>
    </message>
    <message>
        <location filename="../names.py" line="29"/>
        <source>Compared with</source>
        <translation>Porovnává se s</translation>
    </message>
    <message>
        <location filename="../names.py" line="39"/>
        <source>the way to the Car&apos;s outline</source>
        <translation>cesta k obrysu auta</translation>
    </message>
    <message>
        <location filename="../names.py" line="40"/>
        <source>the way to an anchor</source>
        <translation>cesta ke kotvě</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Standstill before a reading</source>
        <translation>Stání před čtením</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Reading time</source>
        <translation>Doba čtení</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Distances at least</source>
        <translation>Nejméně vzdáleností</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Age at most</source>
        <translation>Nejvyšší stáří</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Step of the distances</source>
        <translation>Krok vzdáleností</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Anchor ahead of the centre</source>
        <translation>Kotva před středem</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Anchor to the left</source>
        <translation>Kotva vlevo</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Anchor height</source>
        <translation>Výška kotvy</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Shortest rest</source>
        <translation>Nejkratší klid</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Longest rest</source>
        <translation>Nejdelší klid</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Time left open</source>
        <translation>Neurčená doba</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Trials that confirm</source>
        <translation>Potvrzující pokusy</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Requests to a silent key</source>
        <translation>Dotazy na mlčící klíč</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Trials at most</source>
        <translation>Nejvýše pokusů</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Way that wakes the key</source>
        <translation>Dráha k probuzení klíče</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Places beyond the border</source>
        <translation>Místa za hranicí</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Requests at each place</source>
        <translation>Počet uchopení na místě</translation>
    </message>
    <message>
        <location filename="../texts/parameter_names.py" line="5"/>
        <source>Time to switch</source>
        <translation>Čas na přepnutí</translation>
    </message>
</context>
<context>
    <name>ParameterDoc</name>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Where the approach ends if the Car stays locked.</source>
        <translation>Kde přibližování skončí, zůstane-li auto zamčené.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Starting distance of each axis.</source>
        <translation>Počáteční vzdálenost na každé ose.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>First piece of the approach, to correct the heading; the retreat ends where it ended.</source>
        <translation>První úsek přiblížení na srovnání směru; kde skončil, tam skončí i couvání.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Distance between neighbouring axes of a side.</source>
        <translation>Vzdálenost sousedních os jedné strany.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Height of the Remote key above ground.</source>
        <translation>Výška klíče nad zemí.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Speed limit on the whole way.</source>
        <translation>Omezení rychlosti na celé cestě.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Speed limit while approaching and retreating; default: the maximum speed.</source>
        <translation>Omezení rychlosti při přibližování a couvání; jinak nejvyšší rychlost.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Gap that has to remain between Remote key and Car.</source>
        <translation>Mezera, která musí zůstat mezi klíčem a autem.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>How long the Car may take to react at the end of the approach and of the retreat.</source>
        <translation>Jak dlouho smí auto na konci přibližování a couvání otálet s reakcí.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>How long to wait at the starting distance for the Car to be locked.</source>
        <translation>Jak dlouho čekat v počáteční vzdálenosti, než se auto zamkne.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Nearest place at which the button is pressed.</source>
        <translation>Nejbližší místo, kde se tlačítko stiskne.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Starting distance of each radial.</source>
        <translation>Počáteční vzdálenost na každém paprsku.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>First piece of the approach, to correct the heading; the first press is at its end.</source>
        <translation>První úsek přiblížení na srovnání směru; na jeho konci je první stisk.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Step towards the Car after a press without success.</source>
        <translation>Krok k autu po neúspěšném stisku.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Angle between neighbouring radials.</source>
        <translation>Úhel mezi sousedními paprsky.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Travel of the button: 1 is pressed down fully.</source>
        <translation>Zdvih tlačítka: 1 je úplné stisknutí.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>How long the button is held down.</source>
        <translation>Jak dlouho se tlačítko drží.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Standstill before each press.</source>
        <translation>Doba klidu před každým stiskem.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>How long after the beginning of a press the Car may take to react.</source>
        <translation>Jak dlouho po začátku stisku smí auto otálet s reakcí.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Presses at each place before it counts as failed.</source>
        <translation>Počet stisků na místě, než platí za neúspěšné.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Before the test the robot looks at the Car again from two places; it does not begin when the Car stands elsewhere than it was measured.</source>
        <translation>Před testem si robot auto znovu prohlédne ze dvou míst; stojí-li auto jinde, než bylo změřeno, test nezačne.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>How far the Remote key may be beside the line when something is measured.</source>
        <translation>Jak daleko stranou od osy smí být klíč, když se měří.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>How far the robot may be turned from the line when something is measured.</source>
        <translation>Jak smí být robot natočen od osy, když se měří.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>How far the Remote key may be from its height while a line is measured.</source>
        <translation>O kolik se smí výška klíče lišit, dokud se osa měří.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>How much faster than wanted the robot may be when something is measured.</source>
        <translation>O kolik smí robot jet rychleji, než má, když se měří.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Approaches and retreats on each axis; those at two speeds tell the Car&apos;s reaction time from the static boundary.</source>
        <translation>Přiblížení a vzdálení na každé ose; dvě rychlosti oddělí reakční dobu auta od statické hranice.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Speed limits of the passes, in turn; default: proposed from the cycle of the Car&apos;s message.</source>
        <translation>Nejvyšší rychlosti průjezdů, postupně; výchozí: navržené podle periody zprávy auta.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Sigma of the static boundary for which the speeds are proposed.</source>
        <translation>Sigma statické hranice, pro kterou se rychlosti navrhují.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Step of one more approach, with a stop for the response time after each, for Cars that poll slowly; default: none.</source>
        <translation>Krok ještě jednoho přiblížení se zastavením na dobu odezvy po každém kroku, pro auta s pomalým dotazováním; výchozí: žádný.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>adaptive: search for the distances at which 50 and 95 % of the presses work, with their intervals. scan: from far to near until a press works, as the thesis does; it reads too far where the Car&apos;s range is no sharp border.</source>
        <translation>adaptive: hledá vzdálenosti, na které funguje 50 a 95 % stisků, a jejich intervaly. scan: z dálky k autu, dokud stisk nefunguje, jako v diplomové práci; kde dosah auta nemá ostrou hranici, naměří příliš mnoho.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Half the width of the 95 % interval of the distance at which a radial ends.</source>
        <translation>Polovina šířky 95% intervalu vzdálenosti, při které paprsek končí.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Presses after which a radial ends although its interval is wider.</source>
        <translation>Počet stisků, po kterém paprsek končí, i když je jeho interval širší.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Radio frequency of the Remote key: presses half a wavelength apart meet another fading.</source>
        <translation>Rádiová frekvence klíče: stisky vzdálené půl vlnové délky mají jiný únik signálu.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Standstill after which the Remote key is moved before it is pressed, so that it does not sleep.</source>
        <translation>Doba klidu, po které se klíč před stiskem pohne, aby neusnul.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Nearest places of the map.</source>
        <translation>Nejbližší místa mapy.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Farthest places of the map.</source>
        <translation>Nejvzdálenější místa mapy.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Distance between neighbouring places away from the Car.</source>
        <translation>Vzdálenost sousedních míst směrem od auta.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Highest of the heights at which the map is made, if there are several.</source>
        <translation>Nejvyšší z výšek, ve kterých se mapa pořizuje, je-li jich více.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Heights at which the map is made.</source>
        <translation>Počet výšek, ve kterých se mapa pořizuje.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Half the width of the 95 % interval of a zone&apos;s coverage at which the zone ends.</source>
        <translation>Polovina šířky 95% intervalu pokrytí zóny, při které zóna končí.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Presses in a zone after which it ends anyway.</source>
        <translation>Počet stisků v zóně, po kterém zóna končí v každém případě.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Half a wavelength of the Remote key&apos;s radio: 0.35 m at 434 MHz, 0.17 m at 868 MHz.</source>
        <translation>Polovina vlnové délky klíče: 0,35 m při 434 MHz, 0,17 m při 868 MHz.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Presses at the place of one that worked; unless one of them works too, another key or a late answer may have been taken for it, and the place counts as failed. 0: none, as the thesis does.</source>
        <translation>Stisky na místě toho, který zafungoval; nezafunguje-li žádný z nich, mohl být za něj zaměněn jiný klíč nebo opožděná odpověď a místo platí za neúspěšné. 0: žádné, jako v diplomové práci.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Nearest place at which the handle is taken.</source>
        <translation>Nejbližší místo, při kterém se uchopí klika.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>First piece of the approach, to correct the heading; the farthest request is at its end.</source>
        <translation>První úsek přiblížení k vyrovnání směru; na jeho konci je nejvzdálenější žádost.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Nominal border of the zone, where the first requests of each axis are made.</source>
        <translation>Jmenovitá hranice zóny, kde se na každé ose uskuteční první žádosti.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Requests at the nominal border on each axis before the border is searched; 0: only the search.</source>
        <translation>Žádosti na jmenovité hranici každé osy, než se hranice hledá; 0: jen hledání.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Half the width of the 95 % interval of the border at which an axis ends.</source>
        <translation>Polovina šířky 95% intervalu hranice, při které osa končí.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Requests after which an axis ends although its interval is wider.</source>
        <translation>Počet žádostí, po kterém osa končí, i když je její interval širší.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Highest of the heights at which the border is measured, if there are several.</source>
        <translation>Nejvyšší z výšek, ve kterých se hranice měří, je-li jich více.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Heights at which the border is measured.</source>
        <translation>Počet výšek, ve kterých se hranice měří.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Standstill before each request.</source>
        <translation>Doba klidu před každou žádostí.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>How long after the handle was taken the Car may take to unlock; outside otherwise.</source>
        <translation>Jak dlouho po uchopení kliky se auto smí odemykat; jinak je klíč venku.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>How long the Operator may take to come to the handle before the test is interrupted.</source>
        <translation>Jak dlouho smí obsluze trvat, než přijde ke klice; pak se test přeruší.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>How long the Car may take to lock by itself, as the key goes away or by its timer.</source>
        <translation>Jak dlouho smí autu trvat, než se samo zamkne odchodem klíče nebo časovačem.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Requests so far apart meet another field; half a wavelength of the Remote key&apos;s radio: 0.35 m at 434 MHz, 0.17 m at 868 MHz.</source>
        <translation>Žádosti takto vzdálené od sebe potkávají jiné pole; polovina vlnové délky rádia klíče: 0,35 m na 434 MHz, 0,17 m na 868 MHz.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Standstill after which the Remote key is moved before the handle is taken, so that it does not sleep.</source>
        <translation>Doba klidu, po které se klíčem před uchopením kliky pohne, aby neusnul.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Side or corner of the Car whose border is measured: that of the handle that is taken.</source>
        <translation>Strana nebo roh auta, jehož hranice se měří: ta s klikou, která se uchopí.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>How the Car is locked again after each unlock. button: the robot presses the key&apos;s lock button. itself: the robot drives away and waits, for a key whose button it cannot press.</source>
        <translation>Jak se auto po každém odemčení znovu zamkne. button: robot stiskne na klíči tlačítko zamčení. itself: robot odjede a počká, pro klíč, jehož tlačítko stisknout nemůže.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="75"/>
        <source>Nearest places at which the distance is read.</source>
        <translation>Nejbližší místa, na kterých se vzdálenost čte.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="75"/>
        <source>Farthest places at which the distance is read.</source>
        <translation>Nejvzdálenější místa, na kterých se vzdálenost čte.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="75"/>
        <source>Standstill before the distance is read.</source>
        <translation>Stání před čtením vzdálenosti.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="75"/>
        <source>How long the distance is read at each place.</source>
        <translation>Jak dlouho se vzdálenost na každém místě čte.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="75"/>
        <source>Minimum number of reported distances at a place, and of changes among them; at least 4 changes are needed in any case.</source>
        <translation>Nejmenší počet hlášených vzdáleností na místě a jejich změn; v každém případě jsou třeba aspoň 4 změny.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="75"/>
        <source>Longest time for which the newest reported distance may stand; a place where it is older is invalid.</source>
        <translation>Nejdelší doba, po kterou smí platit nejnovější hlášená vzdálenost; místo, kde je starší, je neplatné.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="75"/>
        <source>Step of the reported distances.</source>
        <translation>Krok hlášených vzdáleností.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="75"/>
        <source>What the reported distance is compared with. outline: the shortest way from the phone to the Car&apos;s outline, over ground. anchor: the straight way to a point of the Car, with the difference in height.</source>
        <translation>S čím se hlášená vzdálenost porovnává. outline: nejkratší cesta od telefonu k obrysu auta, po zemi. anchor: přímá cesta k bodu auta, s rozdílem výšek.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="75"/>
        <source>The anchor, ahead of the Car&apos;s centre.</source>
        <translation>Kotva, před středem auta.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="75"/>
        <source>The anchor, to the left of the Car&apos;s centre.</source>
        <translation>Kotva, vlevo od středu auta.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="75"/>
        <source>Height of the anchor above ground.</source>
        <translation>Výška kotvy nad zemí.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Side or corner of the Car at which the key is held: that of the handle that is taken.</source>
        <translation>Strana nebo roh auta, u nichž se klíč drží: ta s klikou, za kterou se bere.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Where the Remote key is held still, well inside the zone.</source>
        <translation>Kde se klíč drží v klidu, bezpečně uvnitř zóny.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Rest after which the key is asked first.</source>
        <translation>Doba klidu, po které se klíč osloví poprvé.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Longest rest; a key that still answers after it is recorded as awake for at least so long.</source>
        <translation>Nejdelší doba klidu; klíč, který odpoví i po ní, se zapíše jako bdělý nejméně po tuto dobu.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Time between the last answer and the first silence at which the search ends.</source>
        <translation>Doba mezi poslední odpovědí a prvním mlčením, při které hledání skončí.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Trials at each end of that time that have to agree.</source>
        <translation>Kolik pokusů se na každém konci této doby musí shodnout.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Requests without an answer, one right after the other, before the key counts as asleep.</source>
        <translation>Kolik dotazů těsně po sobě musí zůstat bez odpovědi, aby se klíč počítal za spící.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>Trials after which the search ends although its interval is wider.</source>
        <translation>Počet pokusů, po kterém hledání skončí, i když je interval širší.</translation>
    </message>
    <message>
        <location filename="../texts/parameter_docs.py" line="7"/>
        <source>How far the key is moved and brought back before each trial, so that it is awake.</source>
        <translation>Jak daleko se klíč před každým pokusem posune a vrátí, aby byl bdělý.</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="39"/>
        <source>Side or corner of the Car at which the extender is tried: that of the handle that is taken.</source>
        <translation>Strana nebo roh auta, u nichž se extender zkouší: ta s klikou, za kterou se bere.</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="39"/>
        <source>Where the key has to unlock the Car, well inside the zone: a key that is not heard there says nothing by its silence farther away.</source>
        <translation>Kde klíč musí auto odemknout, bezpečně uvnitř zóny: mlčení klíče, který není slyšet ani tam, dál od auta nic neříká.</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="39"/>
        <source>Nominal border of the zone; an unlock beyond it is one too many.</source>
        <translation>Jmenovitá hranice zóny; každé odemčení za ní je o jedno víc, než smí být.</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="39"/>
        <source>Farthest place at which the key is carried, and starting distance of each axis.</source>
        <translation>Nejvzdálenější místo, na které se klíč nese, a počáteční vzdálenost každé osy.</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="39"/>
        <source>Places beyond the border at which the handle is taken, up to 8. Without it half way from the border to the farthest place, and there.</source>
        <translation>Místa za hranicí, při kterých se uchopí klika, nejvýše 8. Bez nich v polovině cesty od hranice k nejvzdálenějšímu místu a na něm.</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="39"/>
        <source>Requests at each place with the extender off, and again with it on.</source>
        <translation>Počet uchopení kliky na každém místě s vypnutým extenderem a znovu se zapnutým.</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="39"/>
        <source>How long the Operator may take to switch the extender before the test is interrupted.</source>
        <translation>Jak dlouho smí obsluze trvat přepnutí extenderu, než se test přeruší.</translation>
    </message>
</context>
<context>
    <name>ParameterField</name>
    <message>
        <location filename="../forms/parameter_field.py" line="47"/>
        <source>{low} to {high} {unit}; may be empty</source>
        <translation>{low} až {high} {unit}; smí být prázdné</translation>
    </message>
    <message>
        <location filename="../forms/parameter_field.py" line="49"/>
        <source>{low} to {high} {unit}, usually {default}</source>
        <translation>{low} až {high} {unit}, obvykle {default}</translation>
    </message>
    <message>
        <location filename="../forms/parameter_field.py" line="56"/>
        <source>Enter a value from {low} to {high} {unit}.</source>
        <translation>Zadejte hodnotu od {low} do {high} {unit}.</translation>
    </message>
    <message>
        <location filename="../forms/parameter_field.py" line="57"/>
        <source>This is not a number; allowed is {low} to {high} {unit}.</source>
        <translation>Toto není číslo; povoleno je {low} až {high} {unit}.</translation>
    </message>
    <message>
        <location filename="../forms/parameter_field.py" line="58"/>
        <source>Only whole numbers are allowed, {low} to {high} {unit}.</source>
        <translation>Povolena jsou jen celá čísla, {low} až {high} {unit}.</translation>
    </message>
    <message>
        <location filename="../forms/parameter_field.py" line="59"/>
        <source>Allowed is {low} to {high} {unit}.</source>
        <translation>Povoleno je {low} až {high} {unit}.</translation>
    </message>
</context>
<context>
    <name>ParameterForm</name>
    <message>
        <location filename="../forms/parameter_form.py" line="46"/>
        <source>Usual values</source>
        <translation>Obvyklé hodnoty</translation>
    </message>
    <message>
        <location filename="../forms/parameter_form.py" line="118"/>
        <source>Fewer parameters</source>
        <translation>Méně parametrů</translation>
    </message>
    <message>
        <location filename="../forms/parameter_form.py" line="118"/>
        <source>More parameters</source>
        <translation>Více parametrů</translation>
    </message>
</context>
<context>
    <name>PhotosRow</name>
    <message>
        <location filename="../forms/photos_row.py" line="31"/>
        <source>Add photos</source>
        <translation>Přidat fotografie</translation>
    </message>
    <message>
        <location filename="../forms/photos_row.py" line="33"/>
        <source>Without</source>
        <translation>Bez nich</translation>
    </message>
    <message>
        <location filename="../forms/photos_row.py" line="34"/>
        <source>Without photos</source>
        <translation>Bez fotografií</translation>
    </message>
    <message>
        <location filename="../forms/photos_row.py" line="65"/>
        <source>none</source>
        <translation>žádné</translation>
    </message>
</context>
<context>
    <name>Picture</name>
    <message>
        <location filename="../pictures/layers/car_layer.py" line="84"/>
        <source>FRONT</source>
        <translation>PŘEDEK</translation>
    </message>
    <message>
        <location filename="../pictures/legend.py" line="30"/>
        <source>95 % interval</source>
        <translation>95% interval</translation>
    </message>
    <message>
        <location filename="../pictures/legend.py" line="30"/>
        <source>place of the key (1 sigma)</source>
        <translation>místo klíče (1 sigma)</translation>
    </message>
    <message>
        <location filename="../pictures/legend.py" line="30"/>
        <source>border somewhere in between</source>
        <translation>hranice je někde mezi</translation>
    </message>
    <message>
        <location filename="../pictures/legend.py" line="40"/>
        <source>error from {low} to {high} cm</source>
        <translation>chyba od {low} do {high} cm</translation>
    </message>
</context>
<context>
    <name>PicturePanel</name>
    <message>
        <location filename="../pictures/picture_panel.py" line="25"/>
        <source>Ruler</source>
        <translation>Pravítko</translation>
    </message>
    <message>
        <location filename="../pictures/picture_panel.py" line="25"/>
        <source>Ruler: drag from one place to another (R)</source>
        <translation>Pravítko: táhněte z jednoho místa na druhé (R)</translation>
    </message>
    <message>
        <location filename="../pictures/picture_panel.py" line="34"/>
        <source>Zoom in</source>
        <translation>Přiblížit</translation>
    </message>
    <message>
        <location filename="../pictures/picture_panel.py" line="34"/>
        <source>Zoom out</source>
        <translation>Oddálit</translation>
    </message>
    <message>
        <location filename="../pictures/picture_panel.py" line="34"/>
        <source>Show all</source>
        <translation>Zobrazit vše</translation>
    </message>
</context>
<context>
    <name>PictureView</name>
    <message>
        <location filename="../pictures/picture_view.py" line="56"/>
        <source>Car and robot from above; plus and minus zoom, arrows move the picture</source>
        <translation>Auto a robot shora; plus a minus mění zvětšení, šipky posouvají obraz</translation>
    </message>
</context>
<context>
    <name>PreflightDetails</name>
    <message>
        <location filename="../header/preflight_details.py" line="54"/>
        <source>Fewer sentences of the preflight</source>
        <translation>Méně vět z kontroly robotu</translation>
    </message>
    <message>
        <location filename="../header/preflight_details.py" line="54"/>
        <source>All sentences of the preflight</source>
        <translation>Všechny věty z kontroly robotu</translation>
    </message>
</context>
<context>
    <name>PresenceBanner</name>
    <message>
        <location filename="../header/presence_banner.py" line="23"/>
        <source>Are you present and in sight of the robot? Without an answer within a minute it stops and the test pauses.</source>
        <translation>Jste přítomni a máte robot na dohled? Bez odpovědi do minuty zastaví a zkouška se přeruší.</translation>
    </message>
    <message>
        <location filename="../header/presence_banner.py" line="26"/>
        <source>I am present (F9)</source>
        <translation>Jsem přítomen (F9)</translation>
    </message>
</context>
<context>
    <name>Protocol</name>
    <message>
        <location filename="../pictures/protocol_sheet.py" line="97"/>
        <source>{scenario} protocol</source>
        <translation>Protokol {scenario}</translation>
    </message>
    <message>
        <location filename="../pictures/protocol_sheet.py" line="115"/>
        <source>Result</source>
        <translation>Výsledek</translation>
    </message>
    <message>
        <location filename="../pictures/protocol_sheet.py" line="115"/>
        <source>Parameters</source>
        <translation>Parametry</translation>
    </message>
    <message>
        <location filename="../pictures/protocol_sheet.py" line="115"/>
        <source>Test</source>
        <translation>Test</translation>
    </message>
    <message>
        <location filename="../pictures/protocol_sheet.py" line="68"/>
        <source>page {page} of {count}</source>
        <translation>strana {page} z {count}</translation>
    </message>
    <message>
        <location filename="../pictures/protocol_tables.py" line="87"/>
        <source>Lines</source>
        <translation>Přímky</translation>
    </message>
    <message>
        <location filename="../pictures/protocol_tables.py" line="87"/>
        <source>Minimum [m]</source>
        <translation>Minimum [m]</translation>
    </message>
    <message>
        <location filename="../pictures/protocol_tables.py" line="87"/>
        <source>Mean [m]</source>
        <translation>Průměr [m]</translation>
    </message>
    <message>
        <location filename="../pictures/protocol_tables.py" line="87"/>
        <source>Maximum [m]</source>
        <translation>Maximum [m]</translation>
    </message>
    <message>
        <location filename="../pictures/protocol_tables.py" line="87"/>
        <source>Worst line</source>
        <translation>Nejhorší</translation>
    </message>
    <message>
        <location filename="../pictures/protocol_tables.py" line="139"/>
        <source>Course of the test</source>
        <translation>Průběh testu</translation>
    </message>
    <message>
        <location filename="../pictures/identity_tables.py" line="37"/>
        <source>Identity</source>
        <translation>Identita</translation>
    </message>
</context>
<context>
    <name>ProtocolFiles</name>
    <message>
        <location filename="../screens/protocol_files.py" line="100"/>
        <source>No file manager opens it; the files are in {folder}</source>
        <translation>Žádný správce souborů ji neotevře; soubory jsou ve složce {folder}</translation>
    </message>
    <message>
        <location filename="../screens/protocol_files.py" line="111"/>
        <source>Saved {files} to {folder}</source>
        <translation>Uloženo: {files}, složka {folder}</translation>
    </message>
    <message>
        <location filename="../screens/protocol_files.py" line="116"/>
        <source>The bundle is written: {percent} %.</source>
        <translation>Balíček se zapisuje: {percent} %.</translation>
    </message>
    <message>
        <location filename="../screens/protocol_files.py" line="119"/>
        <source>It is bundle {number} of {station}.</source>
        <translation>Je to balíček {number} stanice {station}.</translation>
    </message>
    <message>
        <location filename="../screens/protocol_files.py" line="122"/>
        <source>Left out is {name}: {reason}</source>
        <translation>Chybí {name}: {reason}</translation>
    </message>
    <message>
        <location filename="../screens/protocol_files.py" line="129"/>
        <source>Choose another folder; nothing is lost.</source>
        <translation>Vyberte jinou složku; nic se neztratilo.</translation>
    </message>
    <message>
        <location filename="../screens/protocol_files.py" line="138"/>
        <source>Folder for results</source>
        <translation>Složka pro výsledky</translation>
    </message>
</context>
<context>
    <name>ProtocolScreen</name>
    <message>
        <location filename="../screens/protocol.py" line="73"/>
        <source>Save</source>
        <translation>Uložit</translation>
    </message>
    <message>
        <location filename="../screens/protocol.py" line="74"/>
        <source>Save as CSV and PNG</source>
        <translation>Uložit jako CSV a PNG</translation>
    </message>
    <message>
        <location filename="../screens/protocol.py" line="75"/>
        <source>Save PDF</source>
        <translation>Uložit PDF</translation>
    </message>
    <message>
        <location filename="../screens/protocol.py" line="76"/>
        <source>Save SVG</source>
        <translation>Uložit SVG</translation>
    </message>
    <message>
        <location filename="../screens/protocol.py" line="77"/>
        <source>Show folder</source>
        <translation>Ukázat složku</translation>
    </message>
    <message>
        <location filename="../screens/protocol.py" line="86"/>
        <source>New test</source>
        <translation>Nový test</translation>
    </message>
    <message>
        <location filename="../screens/protocol.py" line="147"/>
        <source>{scenario} protocol</source>
        <translation>Protokol {scenario}</translation>
    </message>
    <message>
        <location filename="../screens/protocol.py" line="201"/>
        <source>Verdict: {verdict}.</source>
        <translation>Verdikt: {verdict}.</translation>
    </message>
    <message>
        <location filename="../screens/protocol.py" line="70"/>
        <source>What the uncertainty of the chosen row is made of</source>
        <translation>Z čeho se skládá nejistota vybraného řádku</translation>
    </message>
    <message>
        <location filename="../screens/protocol.py" line="67"/>
        <source>Results; choose a row to see its points, or several to measure them again</source>
        <translation>Výsledky; volbou řádku uvidíte jeho body, více řádků lze změřit znovu</translation>
    </message>
    <message>
        <location filename="../screens/protocol.py" line="79"/>
        <source>Hold to measure again</source>
        <translation>Podržením změřit znovu</translation>
    </message>
    <message>
        <location filename="../screens/protocol.py" line="153"/>
        <source>Not saved as CSV and PNG yet.</source>
        <translation>Zatím neuloženo jako CSV a PNG.</translation>
    </message>
    <message>
        <location filename="../screens/protocol.py" line="209"/>
        <source>{count} lines, {invalid} of them invalid.</source>
        <translation>Počet přímek: {count}, z toho neplatných: {invalid}.</translation>
    </message>
    <message>
        <location filename="../screens/protocol.py" line="210"/>
        <source>{count} lines.</source>
        <translation>Počet přímek: {count}.</translation>
    </message>
    <message>
        <location filename="../screens/protocol.py" line="81"/>
        <source>Notes and photos</source>
        <translation>Poznámky a fotky</translation>
    </message>
    <message>
        <location filename="../screens/protocol.py" line="82"/>
        <source>Save evidence bundle</source>
        <translation>Uložit balíček důkazů</translation>
    </message>
    <message>
        <location filename="../screens/protocol.py" line="84"/>
        <source>One signed file with results, recording, profile, software versions and journal</source>
        <translation>Jeden podepsaný soubor s výsledky, záznamem, profilem, verzemi programů a deníkem</translation>
    </message>
</context>
<context>
    <name>ReplayModel</name>
    <message>
        <location filename="../history/replay_window.py" line="46"/>
        <source>Line</source>
        <translation>Přímka</translation>
    </message>
    <message>
        <location filename="../history/replay_window.py" line="46"/>
        <source>In the record [m]</source>
        <translation>V záznamu [m]</translation>
    </message>
    <message>
        <location filename="../history/replay_window.py" line="46"/>
        <source>Now [m]</source>
        <translation>Nyní [m]</translation>
    </message>
    <message>
        <location filename="../history/replay_window.py" line="53"/>
        <source>would change</source>
        <translation>změnila by se</translation>
    </message>
</context>
<context>
    <name>ReplayWindow</name>
    <message>
        <location filename="../history/replay_window.py" line="63"/>
        <source>Computed anew: {name}</source>
        <translation>Přepočteno: {name}</translation>
    </message>
    <message>
        <location filename="../history/replay_window.py" line="64"/>
        <source>Distances as recorded and as they would be now</source>
        <translation>Vzdálenosti podle záznamu a jaké by byly nyní</translation>
    </message>
    <message>
        <location filename="../history/replay_window.py" line="67"/>
        <source>Close</source>
        <translation>Zavřít</translation>
    </message>
    <message>
        <location filename="../history/replay_window.py" line="86"/>
        <source>From the recorded log, the robot&apos;s poses and the car profile as it is now: {changed} of {count} distances would change; the largest difference is {worst} mm.</source>
        <translation>Podle zaznamenaného logu, poloh robotu a nynějšího profilu auta: změnilo by se {changed} z {count} vzdáleností; největší rozdíl je {worst} mm.</translation>
    </message>
</context>
<context>
    <name>ResultsSoFar</name>
    <message>
        <location filename="../screens/results_so_far.py" line="71"/>
        <source>What is measured so far, the newest first</source>
        <translation>Co je dosud změřeno, nejnovější první</translation>
    </message>
</context>
<context>
    <name>RobotForm</name>
    <message>
        <location filename="../forms/robot_form.py" line="29"/>
        <source>IP address</source>
        <translation>IP adresa</translation>
    </message>
    <message>
        <location filename="../forms/robot_form.py" line="29"/>
        <source>of the robot, e.g. 192.168.0.10</source>
        <translation>robotu, např. 192.168.0.10</translation>
    </message>
    <message>
        <location filename="../forms/robot_form.py" line="30"/>
        <source>Subscriber port</source>
        <translation>Port odběratele</translation>
    </message>
    <message>
        <location filename="../forms/robot_form.py" line="30"/>
        <source>where this laptop hears the robot, usually 3334</source>
        <translation>zde počítač slyší robot, obvykle 3334</translation>
    </message>
    <message>
        <location filename="../forms/robot_form.py" line="32"/>
        <source>Publisher port</source>
        <translation>Port vydavatele</translation>
    </message>
    <message>
        <location filename="../forms/robot_form.py" line="32"/>
        <source>where the robot hears this laptop, usually 3333</source>
        <translation>zde robot slyší počítač, obvykle 3333</translation>
    </message>
</context>
<context>
    <name>Scenario</name>
    <message>
        <location filename="../texts/scenarios.py" line="5"/>
        <source>Autolock</source>
        <translation>Autolock</translation>
    </message>
    <message>
        <location filename="../texts/scenarios.py" line="5"/>
        <source>Approach until the Car unlocks, retreat backwards until it locks, on every axis.</source>
        <translation>Na každé ose přibližovat, dokud se auto neodemkne, a couvat, dokud se nezamkne.</translation>
    </message>
    <message>
        <location filename="../texts/scenarios.py" line="5"/>
        <source>Key press</source>
        <translation>Stisk klíče</translation>
    </message>
    <message>
        <location filename="../texts/scenarios.py" line="5"/>
        <source>Press a button on every radial, and find from how far the Car obeys.</source>
        <translation>Na každém paprsku tiskne tlačítko a zjišťuje, na jakou vzdálenost auto poslechne.</translation>
    </message>
    <message>
        <location filename="../texts/scenarios.py" line="5"/>
        <source>Zone map</source>
        <translation>Mapa zón</translation>
    </message>
    <message>
        <location filename="../texts/scenarios.py" line="5"/>
        <source>Press a button where it tells most, in every zone around the Car, and draw the map of where it works.</source>
        <translation>Tiskne tlačítko tam, kde to řekne nejvíce, v každé zóně kolem auta, a kreslí mapu míst, kde funguje.</translation>
    </message>
    <message>
        <location filename="../texts/scenarios.py" line="5"/>
        <source>Handle request</source>
        <translation>Žádost klikou</translation>
    </message>
    <message>
        <location filename="../texts/scenarios.py" line="5"/>
        <source>Have the handle taken with the key at places on every axis, and find where the Car takes the key for outside.</source>
        <translation>Nechat uchopit kliku s klíčem na místech každé osy a najít, odkud auto považuje klíč za vzdálený.</translation>
    </message>
    <message>
        <location filename="../texts/scenarios.py" line="5"/>
        <source>Digital key</source>
        <translation>Digitální klíč</translation>
    </message>
    <message>
        <location filename="../texts/scenarios.py" line="5"/>
        <source>Carry the phone to places around the Car, read there the distance that phone or Car tells, and map its error.</source>
        <translation>Dovézt telefon na místa kolem auta, číst tam vzdálenost, kterou telefon nebo auto hlásí, a zmapovat její chybu.</translation>
    </message>
    <message>
        <location filename="../texts/scenarios.py" line="5"/>
        <source>Sleep time</source>
        <translation>Doba usnutí</translation>
    </message>
    <message>
        <location filename="../texts/scenarios.py" line="5"/>
        <source>Hold the key still near the Car, have the handle taken after ever longer rests, and find after which the key no longer answers.</source>
        <translation>Držet klíč v klidu u auta, po stále delší době klidu nechat vzít za kliku a zjistit, po které už klíč neodpoví.</translation>
    </message>
    <message>
        <location filename="../texts/scenarios.py" line="5"/>
        <source>Relay resistance</source>
        <translation>Odolnost proti přenosu</translation>
    </message>
    <message>
        <location filename="../texts/scenarios.py" line="5"/>
        <source>Have the handle taken with the key beyond the zone, first with an extender switched off, then on, and bound how often the Car unlocks.</source>
        <translation>Nechat uchopit kliku s klíčem za zónou, nejprve s vypnutým extenderem, pak se zapnutým, a shora ohraničit, jak často se auto odemkne.</translation>
    </message>
</context>
<context>
    <name>Sentence</name>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>wait for robot and Car</source>
        <translation>čekám na robot a auto</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>move the key to {} cm</source>
        <translation>klíč jede do výšky {} cm</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>map the Car</source>
        <translation>robot mapuje auto</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>the robot stands still</source>
        <translation>robot stojí</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>the robot does not confirm that it stands still; without an application it stops by itself</source>
        <translation>robot nepotvrdil, že stojí; bez aplikace se zastaví sám</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>axis {} ({}): go to the start</source>
        <translation>osa {} ({}): jízda na začátek</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>approach until the Car unlocks</source>
        <translation>přibližování, dokud se auto neodemkne</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>retreat until the Car locks</source>
        <translation>couvání, dokud se auto nezamkne</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>radial {} ({}): go to the start</source>
        <translation>paprsek {} ({}): jízda na začátek</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>press at {} m</source>
        <translation>stisk ve vzdálenosti {} m</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The Car&apos;s lock state is unknown: {}</source>
        <translation>Stav zámků auta není znám: {}</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The bus does not carry it.</source>
        <translation>Sběrnice jej nepřenáší.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The Car fell silent: {}</source>
        <translation>Auto se odmlčelo: {}</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot did not start within {} s. {}</source>
        <translation>Robot se do {} s nespustil. {}</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot did not start within {} s.</source>
        <translation>Robot se do {} s nespustil.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot did not find the Car within {} s. {}</source>
        <translation>Robot do {} s nenašel auto. {}</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot did not find the Car within {} s.</source>
        <translation>Robot do {} s nenašel auto.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot is controlled by another application; end that one, then start again.</source>
        <translation>Robot ovládá jiná aplikace; ukončete ji a začněte znovu.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The Remote key did not reach the height of {} cm within {} s; it is at {} cm.</source>
        <translation>Klíč nedosáhl výšky {} cm do {} s; je ve výšce {} cm.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot refused the waypoint: {}</source>
        <translation>Robot odmítl cílový bod: {}</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot did not reach the waypoint within {} s. {}</source>
        <translation>Robot nedojel do cílového bodu do {} s. {}</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot did not reach the waypoint within {} s.</source>
        <translation>Robot nedojel do cílového bodu do {} s.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The button could not be pressed: {}</source>
        <translation>Tlačítko nešlo stisknout: {}</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot did not confirm a button press within {} s.</source>
        <translation>Robot do {} s nepotvrdil stisk tlačítka.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>No poses of the robot enclose the instant {} s.</source>
        <translation>Kolem okamžiku {} s nejsou známy polohy robotu.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot&apos;s pose is unknown for {} s around the instant {} s.</source>
        <translation>Poloha robotu není po dobu {} s kolem okamžiku {} s známa.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The progress file holds {} {}; this test has {}.</source>
        <translation>Soubor průběhu obsahuje číslo {1} ({0}); tento test jich má {2}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The Car was still unlocked {} s after the robot had reached the starting distance of {} m; lock it with its key, or increase maximum_distance_m if it locks farther away.</source>
        <translation>Auto bylo ještě {} s po dosažení počáteční vzdálenosti {} m odemčené; zamkněte je klíčem, nebo zvětšete počáteční vzdálenost, zamyká-li dále.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot has been silent for {} s; check the Wi-Fi and that its software runs.</source>
        <translation>Robot mlčí {} s; zkontrolujte Wi-Fi a zda běží jeho software.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot&apos;s ports are open, but no Status has come for {} s; check that both ports are the robot&apos;s. {}</source>
        <translation>Porty robotu jsou otevřené, ale {} s nepřišla zpráva o stavu; zkontrolujte, zda oba porty patří robotu. {}</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot&apos;s ports are open, but no Status has come for {} s; check that both ports are the robot&apos;s.</source>
        <translation>Porty robotu jsou otevřené, ale {} s nepřišla zpráva o stavu; zkontrolujte, zda oba porty patří robotu.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot started anew during the test; the measured lines are kept, go on with a continued test.</source>
        <translation>Robot se během testu spustil znovu; změřené přímky zůstaly uloženy, pokračujte v testu.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Another application has taken over the control of the robot.</source>
        <translation>Řízení robotu převzala jiná aplikace.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The test was interrupted.</source>
        <translation>Test byl přerušen.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The link to the robot was interrupted for {} s.</source>
        <translation>Spojení s robotem bylo na {} s přerušeno.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The link to the robot was interrupted: {}</source>
        <translation>Spojení s robotem bylo přerušeno: {}</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot does not know its position relative to the Car.</source>
        <translation>Robot nezná svou polohu vůči autu.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The Car does not say whether it is locked.</source>
        <translation>Auto nesděluje, zda je zamčené.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot has restarted; the present order was sent to it again.</source>
        <translation>Robot se spustil znovu; současný příkaz mu byl odeslán ještě jednou.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot is not connected.</source>
        <translation>Robot není připojen.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Parameter {} is {}; it has to be below {}, {}.</source>
        <translation>Parametr {} je {}; musí být menší než {}, {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Parameter {} is {}; allowed is at most {}, {}.</source>
        <translation>Parametr {} je {}; povoleno je nejvýše {}, {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Parameter {} is {}; allowed is clearance_m, {}, and more.</source>
        <translation>Parametr {} je {}; povolen je odstup, {}, a více.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Parameter {} is {}; allowed is {}.</source>
        <translation>Parametr {} je {}; povoleno je {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Parameter {} is {}; allowed are {}.</source>
        <translation>Parametr {} je {}; povoleno je {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Parameter {} is {}; {}</source>
        <translation>Parametr {} je {}; {}</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Parameter {} is unknown; {}</source>
        <translation>Parametr {} není znám; {}</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>allowed is a number, {}.</source>
        <translation>povoleno je číslo, {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>write a decimal point: {}.</source>
        <translation>pište desetinnou tečku: {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>did you mean {}?</source>
        <translation>nemá to být {}?</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>known are {}.</source>
        <translation>známé jsou {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Parameter minimum_distance_m is {} m; on the radial of {} degrees that leaves {} m between Remote key and Car, and clearance_m, {} m, has to remain.</source>
        <translation>Nejmenší vzdálenost je {} m; na paprsku {} stupňů tak mezi klíčem a autem zbude {} m, zůstat ale musí odstup {} m.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The test cannot be continued from {}. {}</source>
        <translation>V testu ze souboru {} nelze pokračovat. {}</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>It is not a progress file of this application.</source>
        <translation>Není to soubor průběhu této aplikace.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>It is not a progress file of this application, or of a scenario that it does not know.</source>
        <translation>Není to soubor průběhu této aplikace, nebo patří ke scénáři, který aplikace nezná.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>It has version {}; this application reads version {}.</source>
        <translation>Má verzi {}; tato aplikace čte verzi {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>It belongs to the scenario {}, not to {}.</source>
        <translation>Patří ke scénáři {}, ne k {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>It is damaged: the parameters are missing.</source>
        <translation>Je poškozený: chybí parametry.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>It is damaged: parts of it are missing or of the wrong kind.</source>
        <translation>Je poškozený: části chybí nebo jsou nesprávného druhu.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>It was measured with other parameters: {} was {}, now it is {}.</source>
        <translation>Byl změřen s jinými parametry: {} bylo {}, nyní je {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>It is larger than {} MiB.</source>
        <translation>Je větší než {} MiB.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>It cannot be read: {}.</source>
        <translation>Nelze jej přečíst: {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>It is truncated or not a JSON file.</source>
        <translation>Je useknutý, nebo to není soubor JSON.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The file {} cannot be written: {}.</source>
        <translation>Soubor {} nelze zapsat: {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Results cannot be written to the folder {}: {}.</source>
        <translation>Výsledky nelze zapsat do složky {}: {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The settings in {} were not used. {}</source>
        <translation>Nastavení v souboru {} nebylo použito. {}</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The settings cannot be kept: {}</source>
        <translation>Nastavení nelze uložit: {}</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>They are of another format or version.</source>
        <translation>Má jiný formát nebo verzi.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>They are damaged.</source>
        <translation>Je poškozené.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>They cannot be read.</source>
        <translation>Nelze je přečíst.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The application has a defect: {}: {}</source>
        <translation>Aplikace má chybu: {}: {}</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Robot address is {}; allowed is an IPv4 address or a host name.</source>
        <translation>Adresa robotu je {}; povolena je adresa IPv4 nebo jméno počítače.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Robot address is {}; an IPv4 address is four numbers from 0 to 255 with dots between them.</source>
        <translation>Adresa robotu je {}; adresa IPv4 jsou čtyři čísla od 0 do 255 oddělená tečkami.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The {} is {}; allowed is a whole number from {} to {}.</source>
        <translation>Pole „{}“ obsahuje {}; povoleno je celé číslo od {} do {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The {} is {}; allowed is a whole number.</source>
        <translation>Pole „{}“ obsahuje {}; povoleno je celé číslo.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Subscriber port and publisher port are both {}; the robot uses two different ones.</source>
        <translation>Port odběratele i vydavatele je {}; robot používá dva různé.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>No host of the name {} is known; check the robot&apos;s address.</source>
        <translation>Počítač jménem {} není znám; zkontrolujte adresu robotu.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>No answer from {} within {} s; check the address, the Wi-Fi and that the robot is on.</source>
        <translation>{} do {} s neodpovídá; zkontrolujte adresu, Wi-Fi a zda je robot zapnutý.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Nothing listens on {}; check the port and that the robot&apos;s software runs.</source>
        <translation>Na adrese {} nic neposlouchá; zkontrolujte port a zda běží software robotu.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Cannot reach {}: {}.</source>
        <translation>{} není dosažitelný: {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>CAN interface is {}; allowed are {}.</source>
        <translation>Rozhraní CAN je {}; povolena jsou {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>CAN channel is empty; give the adapter&apos;s port, e.g. /dev/ttyACM0, can0 or PCAN_USBBUS1.</source>
        <translation>Kanál CAN je prázdný; zadejte port adaptéru, např. /dev/ttyACM0, can0 nebo PCAN_USBBUS1.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>CAN bit rate is {}; allowed is {} to {} bit/s.</source>
        <translation>Přenosová rychlost CAN je {}; povoleno je {} až {} bit/s.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>There is no CAN adapter at {}; check the channel and the USB plug.</source>
        <translation>Na {} není adaptér CAN; zkontrolujte kanál a zástrčku USB.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>{} is no serial port; give the CAN adapter&apos;s, e.g. /dev/ttyACM0.</source>
        <translation>{} není sériový port; zadejte port adaptéru CAN, např. /dev/ttyACM0.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Cannot open the {} at {} bit/s: {}.</source>
        <translation>Nelze otevřít {} při {} bit/s: {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The {} has gone: {}.</source>
        <translation>Zařízení zmizelo ({}): {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The {} sends something else than the slcan protocol; check the channel, and that the device is a CAN adapter.</source>
        <translation>Zařízení ({}) neposílá protokol slcan; zkontrolujte kanál a zda jde o adaptér CAN.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The {} does not answer; check the channel, and that the device is a CAN adapter.</source>
        <translation>Zařízení ({}) neodpovídá; zkontrolujte kanál a zda jde o adaptér CAN.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>CAN adapter {} ({})</source>
        <translation>adaptér CAN {} ({})</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>another program uses it</source>
        <translation>používá jej jiný program</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The CAN bus has errors ({} error frames); check bit rate, plug and termination.</source>
        <translation>Na sběrnici CAN jsou chyby (chybových rámců: {}); zkontrolujte rychlost, zástrčku a zakončení.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The Car&apos;s CAN bus is not connected.</source>
        <translation>Sběrnice CAN auta není připojena.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>No CAN adapter is chosen.</source>
        <translation>Není vybrán adaptér CAN.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>No CAN frame for {} s; check the plug, the bit rate and that the Car is awake.</source>
        <translation>Už {} s nepřišel rámec CAN; zkontrolujte zástrčku, rychlost a zda je auto probuzené.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>No message {} (id 0x{}) for {} s although the CAN bus is alive; check the car profile.</source>
        <translation>Zpráva {} (id 0x{}) už {} s nepřišla, ačkoli sběrnice CAN žije; zkontrolujte profil auta.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The clock of the CAN frames is not mapped to the robot&apos;s yet; this takes about two seconds.</source>
        <translation>Hodiny rámců CAN ještě nejsou přepočteny na hodiny robotu; trvá to asi dvě sekundy.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The CAN adapter reports errors on the bus or has left it (bus-off); check bit rate, plug and termination.</source>
        <translation>Adaptér CAN hlásí chyby na sběrnici, nebo se odpojil (bus-off); zkontrolujte rychlost, zástrčku a zakončení.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The CAN adapter is error-passive; check bit rate, plug and termination.</source>
        <translation>Adaptér CAN je ve stavu error-passive; zkontrolujte rychlost, zástrčku a zakončení.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The CAN adapter has failed: {}.</source>
        <translation>Adaptér CAN selhal: {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>There is no car profile {}; shipped are: {}; a path to a YAML file works too.</source>
        <translation>Profil auta {} neexistuje; dodávané jsou: {}; lze zadat i cestu k souboru YAML.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Car profile {}: states must name a value for locked and one for unlocked.</source>
        <translation>Profil auta {}: states musí uvést hodnotu pro locked a pro unlocked.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Car profile {} is no table of names and values.</source>
        <translation>Profil auta {} není tabulka jmen a hodnot.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Car profile {}: source_signal and sources belong together; give both or none.</source>
        <translation>Profil auta {}: source_signal a sources patří k sobě; uveďte obojí, nebo nic.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Car profile {}: {} must be a table from raw value to {}.</source>
        <translation>Profil auta {}: {} musí být tabulka, která hodnotám přiřadí {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Car profile {} cannot be read: {}.</source>
        <translation>Profil auta {} nelze přečíst: {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Car profile {}: unknown entry {}; allowed are {}.</source>
        <translation>Profil auta {}: neznámá položka {}; povoleny jsou {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Car profile {} lacks the entry {}.</source>
        <translation>V profilu auta {} chybí položka {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Car profile {}: {} has {}: {}; allowed is a whole number with {}.</source>
        <translation>Profil auta {}: {} obsahuje {}: {}; povoleno je celé číslo a k němu {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Message {} of CAN database {} has no signal {}.</source>
        <translation>Zpráva {} databáze CAN {} nemá signál {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Message {} of CAN database {} has no signal {}; not all of it could be read: {}.</source>
        <translation>Zpráva {} databáze CAN {} nemá signál {}; databázi se nepodařilo přečíst celou: {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Message {} of CAN database {} has no signal {}; message {}, line {}, could not be read: {}.</source>
        <translation>Zpráva {} databáze CAN {} nemá signál {}; zprávu {} na řádku {} se nepodařilo přečíst: {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>CAN database {} has no message {}.</source>
        <translation>Databáze CAN {} nemá zprávu {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>CAN database {} has no message {}; not all of it could be read: {}.</source>
        <translation>Databáze CAN {} nemá zprávu {}; nepodařilo se ji přečíst celou: {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>CAN database {} has no message {}; message {}, line {}, could not be read: {}.</source>
        <translation>Databáze CAN {} nemá zprávu {}; zprávu {} na řádku {} se nepodařilo přečíst: {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>CAN database {} cannot be read: {}.</source>
        <translation>Databázi CAN {} nelze přečíst: {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>A message of {} bytes was ignored; allowed is at most {} bytes.</source>
        <translation>Zpráva o {} bajtech byla ignorována; povoleno je nejvýše {} bajtů.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>A message was ignored: {}</source>
        <translation>Zpráva byla ignorována: {}</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>wait for the robot</source>
        <translation>čekám na robot</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>check where the Car stands</source>
        <translation>robot ověřuje, kde auto stojí</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>warning: the robot&apos;s software is too old to check where the Car stands; it is taken as it is</source>
        <translation>pozor: software robotu je příliš starý na ověření, kde auto stojí; bere se, jak je</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot has not found the Car yet, so there is nothing to check; a test begins with it.</source>
        <translation>Robot ještě nenašel auto, takže není co ověřit; test tím začíná.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot&apos;s software is too old to check where the Car stands.</source>
        <translation>Software robotu je příliš starý na ověření, kde auto stojí.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot did not check the Car within {} s. {}</source>
        <translation>Robot auto do {} s neověřil. {}</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot did not check the Car within {} s.</source>
        <translation>Robot auto do {} s neověřil.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The test does not begin. {}</source>
        <translation>Test nezačne. {}</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The Car coordinate system was corrected during the measurement.</source>
        <translation>Souřadnicová soustava auta byla během měření opravena.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The Car&apos;s bus is not connected.</source>
        <translation>Sběrnice auta není připojena.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The package mtr_proto, the contract with the robot, is not installed; pip install the folder proto of the project.</source>
        <translation>Balíček mtr_proto, rozhraní k robotu, není nainstalován; nainstalujte složku proto projektu příkazem pip install.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot&apos;s clock was set; the clock of the CAN frames is mapped to it anew, which takes about two seconds.</source>
        <translation>Hodiny robotu byly přestaveny; hodiny rámců CAN se na ně přepočítávají znovu, trvá to asi dvě sekundy.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The clock of the CAN adapter jumped; it is mapped to the robot&apos;s anew, which takes about two seconds.</source>
        <translation>Hodiny adaptéru CAN poskočily; přepočítávají se na hodiny robotu znovu, trvá to asi dvě sekundy.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Frames or messages of the robot are late, or a clock was set; the time at which the locks changed is not known yet.</source>
        <translation>Rámce nebo zprávy robotu se opožďují, nebo byly přestaveny hodiny; čas změny zámků ještě není znám.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The instant of the event is not known.</source>
        <translation>Okamžik události není znám.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>Another application (process {}) is measuring the test in the folder {}; end it there first, or choose another folder.</source>
        <translation>Test ve složce {1} právě měří jiná aplikace (proces {0}); nejprve ji ukončete, nebo vyberte jinou složku.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>Another application is measuring the test in the folder {}; end it there first, or choose another folder.</source>
        <translation>Test ve složce {} právě měří jiná aplikace; nejprve ji ukončete, nebo vyberte jinou složku.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The folder {} cannot be locked against other applications: {}.</source>
        <translation>Složku {} nelze uzamknout proti jiným aplikacím: {}.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The files of {} belong to another test; choose another folder.</source>
        <translation>Soubory {} patří jinému testu; vyberte jinou složku.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The test in {} was gone on with since it was opened here; open it again.</source>
        <translation>V testu {} se od jeho otevření pokračovalo jinde; otevřete jej znovu.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>{} What was measured is in {}.</source>
        <translation>{} Co bylo změřeno, je v souboru {}.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>{} What was measured is kept in {}, with which the test can be continued.</source>
        <translation>{} Co bylo změřeno, je uloženo v souboru {}, s nímž lze v testu pokračovat.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>{} No second place could be written either; what was measured last is in this application only.</source>
        <translation>{} Ani na náhradní místo nelze zapisovat; co bylo změřeno naposledy, je jen v této aplikaci.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>A finding cannot be kept, for a value in it is no finite number.</source>
        <translation>Zjištění nelze uložit, protože některá jeho hodnota není konečné číslo.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The test&apos;s files are not open.</source>
        <translation>Soubory testu nejsou otevřené.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The journal {} is not open.</source>
        <translation>Deník {} není otevřený.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The journal {} is larger than {} MiB.</source>
        <translation>Deník {} je větší než {} MiB.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The journal {} cannot be read: {}.</source>
        <translation>Deník {} nelze číst: {}.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The journal beside it belongs to another test; move that file elsewhere.</source>
        <translation>Deník vedle něj patří jinému testu; přesuňte ho jinam.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The journal does not fit together; the progress file alone counts.</source>
        <translation>Deník si odporuje; platí jen soubor s průběhem.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>Of the journal of {}, its last entry was cut off; the {} entries before that are used.</source>
        <translation>Poslední zápis v deníku testu {} byl useknut; použito je {} zápisů před ním.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The journal of {} is damaged; its first {} entries are used.</source>
        <translation>Deník testu {} je poškozený; použito je prvních {} zápisů.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The progress file {} was recovered from its journal. {}</source>
        <translation>Soubor s průběhem {} byl obnoven z deníku. {}</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>Its Car and its parameters do not fit together. {}</source>
        <translation>Jeho auto a jeho parametry k sobě nepatří. {}</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>CAN database {} is larger than {} KiB; leave the messages that the profile does not name out of it.</source>
        <translation>Databáze CAN {} je větší než {} KiB; vynechte z ní zprávy, které profil nejmenuje.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>CAN database {} cannot be read: it is damaged.</source>
        <translation>Databázi CAN {} nelze číst: je poškozená.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>Car profile {} {}; a profile is a YAML file that names the CAN database.</source>
        <translation>Profil auta {} {}; profil je soubor YAML, který jmenuje databázi CAN.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>is larger than {} KiB</source>
        <translation>je větší než {} KiB</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>is not a text file in UTF-8</source>
        <translation>není textový soubor v UTF-8</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>is not valid YAML</source>
        <translation>není platný YAML</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>is not valid YAML in line {}</source>
        <translation>není platný YAML na řádku {}</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>is not valid YAML: a value in it cannot be read</source>
        <translation>není platný YAML: některou jeho hodnotu nelze přečíst</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>is not valid YAML: too many lists lie within each other</source>
        <translation>není platný YAML: příliš mnoho seznamů v sobě</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>refers to another part of itself; write the value out</source>
        <translation>odkazuje na jinou svou část; hodnotu vypište</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>says {} twice</source>
        <translation>uvádí {} dvakrát</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>They are larger than {} KiB.</source>
        <translation>Jsou větší než {} KiB.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>the robot stands until you have it go on</source>
        <translation>robot stojí, dokud nedáte pokyn pokračovat</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot has been silent for {} s; check the Wi-Fi and that its software runs. {}</source>
        <translation>Robot mlčí už {} s; zkontrolujte Wi-Fi a zda běží jeho software. {}</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Status {} was ignored: {}</source>
        <translation>Stav {} byl ignorován: {}</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot no longer takes this application&apos;s Commands: another application has controlled it meanwhile, or goodbye was said in this one&apos;s name; connect again, or go on with a continued test.</source>
        <translation>Robot už nepřijímá příkazy této aplikace: mezitím ho ovládala jiná aplikace, nebo se někdo rozloučil jejím jménem; připojte se znovu, nebo v testu pokračujte.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Car profile {}: {} is {}; allowed is {} to {} s.</source>
        <translation>Profil auta {}: {} je {}; povoleno je {} až {} s.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>A frame of the Car&apos;s lock message came {} s after a later one.</source>
        <translation>Rámec zprávy o zámcích auta přišel {} s po pozdějším.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>A frame of the Car&apos;s lock message came twice.</source>
        <translation>Rámec zprávy o zámcích auta přišel dvakrát.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>The signal {} of the Car&apos;s lock message stands still at {}.</source>
        <translation>Signál {} zprávy o zámcích auta stojí na hodnotě {}.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>The signal {} of the Car&apos;s lock message went from {} to {}.</source>
        <translation>Signál {} zprávy o zámcích auta přeskočil z {} na {}.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>The signal {} of the Car&apos;s lock message has the unknown value {}.</source>
        <translation>Signál {} zprávy o zámcích auta má neznámou hodnotu {}.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>The Car was {} on its bus, and {} counted no command.</source>
        <translation>Na sběrnici se změnil stav auta („{}“), ale {} nenapočítal žádný povel.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>The Car was {} on its bus, and {} said nothing of a change.</source>
        <translation>Na sběrnici se změnil stav auta („{}“), ale {} o změně nic neřekl.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>{} told of a change, and the Car stayed {} on its bus.</source>
        <translation>{} ohlásil změnu, ale stav auta na sběrnici zůstal („{}“).</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>The Car changed its locks on its bus after {} s; a state lasts at least {} s and {} frames.</source>
        <translation>Stav zámků auta se na sběrnici změnil už po {} s; stav trvá nejméně {} s a {} rámce.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>Nobody knows when the Car&apos;s locks moved: the clocks were set anew.</source>
        <translation>Není známo, kdy se zámky auta pohnuly: hodiny se mezitím přestavily.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>The Car was {} without anything in the test to make it; leave its keys and doors alone during the test.</source>
        <translation>Stav auta („{}“) nezpůsobilo nic z testu; během testu nesahejte na klíče ani na dveře auta.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>The Car was {} twice, without the opposite in between.</source>
        <translation>Auto dvakrát po sobě ohlásilo stav „{}“, aniž by mezitím nastal opačný.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>The Car was {} {} s before {}, by something else; leave its keys and doors alone during the test.</source>
        <translation>Stav auta („{}“) způsobilo něco jiného: nastal {} s dříve než {}; během testu nesahejte na klíče ani na dveře auta.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>The Car was {} {} s too late for {}; increase response_timeout_s if it is so slow.</source>
        <translation>Stav auta („{}“) nastal o {} s později, než by jej způsobil jen {}; je-li auto tak pomalé, zvětšete dobu odezvy.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>The Car was {} when it locks by itself anyway, so that nobody knows whether it was by {}.</source>
        <translation>Stav auta („{}“) nastal, když se auto zamyká i samo; nelze říci, zda jej způsobil {}.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>The Car was {} by the button of a key, not by {}; leave the keys alone during the test.</source>
        <translation>Stav auta („{}“) způsobilo tlačítko klíče, ne {}; během testu na klíče nesahejte.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>The Car was {} by the vicinity of a key, not by {}; switch passive entry off, or increase minimum_distance_m.</source>
        <translation>Stav auta („{}“) způsobila blízkost klíče, ne {}; vypněte bezklíčový přístup, nebo zvětšete nejmenší vzdálenost.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>The Car was {} by something that its profile does not list, not by {}; leave its doors and switches alone during the test.</source>
        <translation>Stav auta („{}“) způsobilo něco, co profil auta neuvádí, ne {}; během testu nesahejte na dveře ani spínače auta.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>the press at {} m</source>
        <translation>stisk ve vzdálenosti {} m</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>the Remote key&apos;s vicinity</source>
        <translation>vliv blízkosti klíče</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>The Car reacted at {} m, where the robot was not to be: the line reaches from {} to {} m.</source>
        <translation>Auto zareagovalo ve vzdálenosti {} m, kde robot neměl být: měří se od {} do {} m.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>The robot was too fast for a measurement: {} m/s; allowed is {} m/s.</source>
        <translation>Robot jel na měření příliš rychle: {} m/s; povoleno je {} m/s.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>The robot does not know the height of the Remote key.</source>
        <translation>Robot nezná výšku klíče.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>The Remote key is at {} cm instead of {} cm; allowed are {} cm of difference.</source>
        <translation>Klíč je ve výšce {} cm místo {} cm; povolený rozdíl je {} cm.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>The Remote key was {} cm beside the line; allowed are {} cm.</source>
        <translation>Klíč byl {} cm stranou od osy; povoleno je {} cm.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>The robot was turned by {} degrees from the line; allowed are {} degrees.</source>
        <translation>Robot byl od osy natočen o {} stupně; povoleno je {} stupně.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>The robot was driven by hand during the measurement.</source>
        <translation>Během měření jel robot podle ručního ovladače.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>The Remote key was moved by hand during the measurement.</source>
        <translation>Během měření se klíč zvedal podle ručního ovladače.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>The robot planned its path anew during the measurement.</source>
        <translation>Během měření robot naplánoval cestu znovu.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>An obstacle, or sensors that saw nothing, stopped the robot during the measurement.</source>
        <translation>Během měření byl robot zastaven překážkou, nebo jeho snímače nic neviděly.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>A motion lock stopped the robot during the measurement.</source>
        <translation>Během měření byl robot zastaven zámkem pohybu.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>The board of lift and servos restarted during the measurement.</source>
        <translation>Během měření se znovu spustila deska zdvihu a serv.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>The robot&apos;s clock was set during the measurement.</source>
        <translation>Během měření se přestavily hodiny robotu.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>The file {} cannot be read: {}.</source>
        <translation>Soubor {} nelze přečíst: {}.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>The file {} {}.</source>
        <translation>Soubor {} {}.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>In the file {}: {}</source>
        <translation>V souboru {}: {}</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>The test was begun with other limits, or with none; continue it without this file, or begin a new test.</source>
        <translation>Test byl zahájen s jinými mezemi nebo bez nich; pokračujte bez tohoto souboru, nebo začněte nový test.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>The test was begun with another calibration record of the robot; continue it without this file, or begin a new test.</source>
        <translation>Test byl zahájen s jiným kalibračním záznamem robotu; pokračujte bez tohoto souboru, nebo začněte nový test.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>The robot&apos;s calibration record of {} is {} days old; it was valid for {} days. Calibrate the robot again, or doubt the uncertainties.</source>
        <translation>Kalibrační záznam robotu z {} je starý {} dní; platil {} dní. Robot znovu zkalibrujte, nebo nejistotám nevěřte.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>valid_days has to be a whole number of days from 1 to 3650, or null.</source>
        <translation>valid_days musí být celý počet dní od 1 do 3650, nebo null.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>{}distribution has to be one of {}.</source>
        <translation>{}distribution musí být jedno z {}.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>{}it has to consist of lines of the form &apos;name: value&apos;.</source>
        <translation>{}musí se skládat z řádků ve tvaru „jméno: hodnota“.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>{}{} is missing.</source>
        <translation>{}{} chybí.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>{}{} is unknown; known are {}.</source>
        <translation>{}{} není známo; známé jsou {}.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>{} has to be a text of 1 to {} characters in one line.</source>
        <translation>{} musí být text o 1 až {} znacích na jednom řádku.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>date has to be a day such as 2026-03-01.</source>
        <translation>date musí být den, například 2026-03-01.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>It has to consist of lines of the form &apos;name: value&apos;, one of them &apos;limits:&apos;.</source>
        <translation>Musí se skládat z řádků ve tvaru „jméno: hodnota“, z nichž jeden je „limits:“.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>&apos;limits&apos; has to be a list of 1 to {} limits.</source>
        <translation>„limits“ musí být seznam 1 až {} mezí.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>Two limits are called {}; give each a name of its own.</source>
        <translation>Dvě meze se jmenují {}; každá musí mít vlastní jméno.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>{}share_percent has to be one of {}.</source>
        <translation>{}share_percent musí být jedno z {}.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>{}sides has to be a list of sides, such as [left, front_left].</source>
        <translation>{}sides musí být seznam stran, například [left, front_left].</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>{}angles_deg has to be a list of two angles, such as [225, 315].</source>
        <translation>{}angles_deg musí být seznam dvou úhlů, například [225, 315].</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>{}angles_deg goes round more than once.</source>
        <translation>{}angles_deg obíhá více než jednou.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>{}{} has to be a text of 1 to {} characters in one line.</source>
        <translation>{}{} musí být text o 1 až {} znacích na jednom řádku.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>{}side {} is unknown; known are {}.</source>
        <translation>{}strana {} není známa; známé jsou {}.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>{}{} is unknown; {}</source>
        <translation>{}{} není známo; {}</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>Limit {}: {} measures no {}; it measures {}.</source>
        <translation>Mez {}: {} neměří {}; měří {}.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>Limit {}: with these parameters {} does not say how sure a distance is; no limit can be judged.</source>
        <translation>Mez {}: s těmito parametry {} neříká, jak jistá vzdálenost je; žádnou mez nelze posoudit.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>Limit {}: {} tells the distance for {} % of the attempts, not for {} %.</source>
        <translation>Mez {}: {} udává vzdálenost pro {} % pokusů, ne pro {} %.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>Limit {}: it is at {} m, and the test measures from {} to {} m only; no measurement could judge it.</source>
        <translation>Mez {}: leží v {} m a test měří jen od {} do {} m; žádné měření by ji neposoudilo.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>Limit {} names no {} of this test.</source>
        <translation>Mez {} neoznačuje v tomto testu nic, co se měří ({}).</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>Limits {} and {} contradict each other on {} {}: {}, {}.</source>
        <translation>Meze {} a {} si odporují ({} {}): {}, {}.</translation>
    </message>
    <message>
        <location filename="../texts/passes.py" line="5"/>
        <source>warning: {}</source>
        <translation>upozornění: {}</translation>
    </message>
    <message>
        <location filename="../texts/passes.py" line="5"/>
        <source>pass {}: approach until the Car unlocks</source>
        <translation>průjezd {}: přiblížení, dokud se auto neodemkne</translation>
    </message>
    <message>
        <location filename="../texts/passes.py" line="5"/>
        <source>warning: pass {} of this axis was not measured. {}</source>
        <translation>upozornění: průjezd {} této osy nebyl změřen. {}</translation>
    </message>
    <message>
        <location filename="../texts/passes.py" line="5"/>
        <source>All passes have about the same speed, so that the Car&apos;s reaction time stays inside the distances; give measuring_speeds_mps two speeds.</source>
        <translation>Všechny průjezdy mají přibližně stejnou rychlost, takže reakční doba auta zůstává ve vzdálenostech; zadejte do measuring_speeds_mps dvě rychlosti.</translation>
    </message>
    <message>
        <location filename="../texts/passes.py" line="5"/>
        <source>Parameters measuring_speed_mps and measuring_speeds_mps are both given; give one.</source>
        <translation>Parametry measuring_speed_mps a measuring_speeds_mps jsou zadány oba; zadejte jeden.</translation>
    </message>
    <message>
        <location filename="../texts/passes.py" line="5"/>
        <source>Parameter passes is {}; allowed is at least one for each of the {} speeds of measuring_speeds_mps.</source>
        <translation>Parametr passes je {}; dovolen je alespoň jeden pro každou z {} rychlostí v measuring_speeds_mps.</translation>
    </message>
    <message>
        <location filename="../texts/passes.py" line="5"/>
        <source>Parameter {} is {}; allowed is a list of numbers, {}.</source>
        <translation>Parametr {} je {}; dovolen je seznam čísel, {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>move the key so that it does not sleep</source>
        <translation>pohyb klíčem, aby neusnul</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The key has answered nowhere on {} radials one after the other; see whether it sleeps, whether its battery is empty and whether it is the Car&apos;s key, then continue the test, or begin one with a smaller minimum_distance_m.</source>
        <translation>Klíč na {} paprscích za sebou nikde neodpověděl; zjistěte, zda nespí, zda nemá vybitou baterii a zda patří k autu, pak v testu pokračujte, nebo začněte nový s menší minimum_distance_m.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Parameter minimum_distance_m leaves {} m up to the first press at {} m; the method adaptive needs {} m.</source>
        <translation>Parametr minimum_distance_m nechává {} m k prvnímu stisku na {} m; metoda adaptive potřebuje {} m.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Parameter {} is {}; allowed is {} or {}.</source>
        <translation>Parametr {} je {}; povoleno je {} nebo {}.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>No press worked, and none of {} at {} m either: the key sleeps, its battery is empty, or the Car&apos;s range ends nearer; then decrease minimum_distance_m.</source>
        <translation>Žádný stisk nefungoval, ani žádný z {} na {} m: klíč spí, má vybitou baterii, nebo dosah auta končí blíž; pak zmenšete minimum_distance_m.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>{} presses on each radial reach an interval of {} m where the Car&apos;s range ends within {} m; interval_m asks for {} m: allow {} presses (attempts_limit), or ask for {} m.</source>
        <translation>Kde dosah auta končí pozvolna, dá {} stisků na každém paprsku interval {} m (dosah končí během {} m); interval_m žádá {} m: dovolte {} stisků (attempts_limit), nebo žádejte {} m.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>{} presses on each radial reach an interval of {} m where the Car&apos;s range ends within {} m; interval_m asks for {} m: ask for {} m.</source>
        <translation>Kde dosah auta končí pozvolna, dá {} stisků na každém paprsku interval {} m (dosah končí během {} m); interval_m žádá {} m: žádejte {} m.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>zone {} ({})</source>
        <translation>zóna {} ({})</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>handle request at {} m</source>
        <translation>žádost klikou ve vzdálenosti {} m</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>the handle request at {} m</source>
        <translation>žádost klikou ve vzdálenosti {} m</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>have the Car locked again</source>
        <translation>opětovné zamčení auta</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>{} requests on each axis reach an interval of {} m where the Car&apos;s range ends within {} m; interval_m asks for {} m: allow {} requests (attempts_limit), or ask for {} m.</source>
        <translation>{} žádostí na každé ose dosáhne intervalu {} m tam, kde dosah auta končí během {} m; interval_m žádá {} m: povolte {} žádostí (attempts_limit), nebo žádejte {} m.</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>{} requests on each axis reach an interval of {} m where the Car&apos;s range ends within {} m; interval_m asks for {} m: ask for {} m.</source>
        <translation>{} žádostí na každé ose dosáhne intervalu {} m tam, kde dosah auta končí během {} m; interval_m žádá {} m: žádejte {} m.</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>Nobody takes the Car&apos;s handle: its profile declares no handle_request, and there is no Operator to ask; add one to the profile, or start the test where a person can answer.</source>
        <translation>Kliku auta nikdo neuchopí: jeho profil neuvádí handle_request a není zde obsluha, které by se šlo zeptat; doplňte jej do profilu, nebo test spusťte tam, kde může někdo odpovědět.</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>Nobody has taken the Car&apos;s handle within {} s; continue the test when somebody is there to do it, or increase handle_timeout_s.</source>
        <translation>Kliku auta do {} s nikdo neuchopil; pokračujte v testu, až bude někdo na místě, nebo zvětšete handle_timeout_s.</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>The handle was taken {} times only after the key had stood for more than {} s, when it may sleep; take it sooner, or increase key_rest_limit_s if the key stays awake.</source>
        <translation>Klika byla {}krát uchopena, až když klíč stál déle než {} s a mohl spát; uchopte ji dříve, nebo zvětšete key_rest_limit_s, pokud klíč neusíná.</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>The Car was not locked again, not even {} s after the key had gone away; lock it, and see whether its key&apos;s lock button and its own lock work.</source>
        <translation>Auto se znovu nezamklo ani {} s po odjezdu klíče; zamkněte je a zjistěte, zda funguje tlačítko zamčení na klíči a vlastní zamykání auta.</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>The Car was {} by its handle, not by {}; leave its handles alone during the test.</source>
        <translation>Stav auta („{}“) způsobila jeho klika, ne {}; během testu na kliky nesahejte.</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>No handle request unlocked the Car, and none of {} at {} m either: the key sleeps, its battery is empty, the handle was not taken, or the zone ends nearer; then decrease minimum_distance_m.</source>
        <translation>Žádná žádost klikou auto neodemkla, ani žádná z {} na {} m: klíč spí, má vybitou baterii, klika nebyla uchopena, nebo zóna končí blíž; pak zmenšete minimum_distance_m.</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>No handle request has unlocked the Car on {} axes one after the other; see whether the key sleeps, whether its battery is empty, whether it is the Car&apos;s key and whether the handle of this side is taken, then continue the test, or begin one of another side or with a smaller minimum_distance_m.</source>
        <translation>Na {} osách za sebou žádná žádost klikou auto neodemkla; zjistěte, zda klíč nespí, zda nemá vybitou baterii, zda je to klíč tohoto auta a zda se uchopuje klika této strany, pak v testu pokračujte, nebo začněte test jiné strany či s menším minimum_distance_m.</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>Parameter minimum_distance_m leaves {} m up to the first request at {} m; the search needs {} m.</source>
        <translation>Parametr minimum_distance_m nechává {} m do první žádosti na {} m; hledání potřebuje {} m.</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>Parameter minimum_distance_m is {} m; allowed is clearance_m, {} m, and more.</source>
        <translation>Parametr minimum_distance_m je {} m; povoleno je clearance_m, {} m, a více.</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>Parameter border_distance_m is {} m; allowed is {} to {} m, where requests are made.</source>
        <translation>Parametr border_distance_m je {} m; povoleno je {} až {} m, kde se žádosti uskutečňují.</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>Parameter border_requests is {}; allowed is at most attempts_limit, {}.</source>
        <translation>Parametr border_requests je {}; povoleno je nejvýše attempts_limit, {}.</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>Parameter highest_key_height_m is {} m; it has to be above key_height_m, {} m.</source>
        <translation>Parametr highest_key_height_m je {} m; musí být větší než key_height_m, {} m.</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>Car profile {}: handle_request must be a table of {}.</source>
        <translation>Profil auta {}: handle_request musí být tabulka s položkami {}.</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>Car profile {}: handle_request has {}: {}; allowed is a whole number.</source>
        <translation>Profil auta {}: handle_request má {}: {}; povoleno je celé číslo.</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>Car profile {}: taken and released of handle_request are both {}; give two values.</source>
        <translation>Profil auta {}: taken i released v handle_request jsou {}; uveďte dvě různé hodnoty.</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>Signal {} of message {} cannot carry the value {}.</source>
        <translation>Signál {} zprávy {} nemůže nést hodnotu {}.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>{} at least {} m for {} % of the attempts</source>
        <translation>{} alespoň {} m pro {} % pokusů</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>{} at most {} m for {} % of the attempts</source>
        <translation>{} nejvýše {} m pro {} % pokusů</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>Wanted is {}; at {} m attempts failed again and again.</source>
        <translation>Požaduje se {}; na {} m pokusy opakovaně selhaly.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>Wanted is {}; it {}.</source>
        <translation>Požaduje se {}; hodnota {}.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>Wanted is {}; it {}, which holds the limit.</source>
        <translation>Požaduje se {}; hodnota {}, takže mez leží v intervalu.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>is below {} m</source>
        <translation>je pod {} m</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>is above {} m</source>
        <translation>je nad {} m</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>lies between {} and {} m</source>
        <translation>leží mezi {} a {} m</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>The line was not measured.</source>
        <translation>Přímka nebyla změřena.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>The line does not tell this distance.</source>
        <translation>Přímka tuto vzdálenost neuvádí.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>The measurement does not say how sure it is.</source>
        <translation>Měření neuvádí, jak je jisté.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>The key worked nowhere in this test; it may have been asleep.</source>
        <translation>Klíč v tomto testu nefungoval nikde; mohl spát.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>calibration record of {}: {}</source>
        <translation>kalibrační záznam z {}: {}</translation>
    </message>
    <message>
        <location filename="../texts/figures.py" line="15"/>
        <source>Beside each distance stands 1 sigma of where the Remote key was at this one event; at another attempt the Car may react elsewhere, by more than that.</source>
        <translation>U každé vzdálenosti je 1 sigma místa, kde byl klíč při této jedné události; při jiném pokusu může auto zareagovat jinde, i o více než to.</translation>
    </message>
    <message>
        <location filename="../texts/figures.py" line="15"/>
        <source>Beside each distance stands 1 sigma of the boundary, and its 95 % interval: in 95 of 100 tests like this one it holds where the Car decides either way equally often.</source>
        <translation>U každé vzdálenosti je 1 sigma hranice a její 95% interval: v 95 ze 100 takových testů obsahuje místo, kde se auto rozhoduje tak i onak stejně často.</translation>
    </message>
    <message>
        <location filename="../texts/figures.py" line="15"/>
        <source>Of a range between two places the nearer one is the farthest press that worked, the other the next one that failed; a range of at least a place worked at the first.</source>
        <translation>U dosahu mezi dvěma místy je bližší nejvzdálenější stisk, který zabral, a druhé nejbližší vzdálenější, který nezabral; dosah nejméně nějaký zabral hned na prvním místě.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The key has answered nowhere in {} zones one after the other; see whether it sleeps, whether its battery is empty and whether it is the Car&apos;s key, then continue the test, or begin one with a smaller minimum_distance_m.</source>
        <translation>Klíč v {} zónách za sebou nikde neodpověděl; zjistěte, zda nespí, zda nemá vybitou baterii a zda patří k autu, pak v testu pokračujte, nebo začněte nový s menší minimum_distance_m.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>No press worked in this zone, not at its nearest places either: the key sleeps, its battery is empty, or the Car&apos;s range ends nearer; then decrease minimum_distance_m.</source>
        <translation>V této zóně nezabral žádný stisk, ani na jejích nejbližších místech: klíč spí, má vybitou baterii, nebo dosah auta končí blíž; pak zmenšete minimum_distance_m.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>{} presses in each zone reach an interval of the coverage of {} %; coverage_percent asks for {} %: allow {} presses (presses_limit), or ask for {} %.</source>
        <translation>{} stisků v každé zóně dosáhne intervalu pokrytí {} %; coverage_percent žádá {} %: povolte {} stisků (presses_limit), nebo žádejte {} %.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>{} presses in each zone reach an interval of the coverage of {} %; coverage_percent asks for {} %: ask for {} %.</source>
        <translation>{} stisků v každé zóně dosáhne intervalu pokrytí {} %; coverage_percent žádá {} %: žádejte {} %.</translation>
    </message>
    <message>
        <location filename="../texts/passes.py" line="5"/>
        <source>At {}, with a message of the Car every {} s, the static boundary of an axis has a sigma of {} m; boundary_sigma_m asks for {} m. {}</source>
        <translation>Při {} a zprávě auta každých {} s má statická hranice osy sigma {} m; boundary_sigma_m žádá {} m. {}</translation>
    </message>
    <message>
        <location filename="../texts/passes.py" line="5"/>
        <source>At {}, with a message of the Car every {} s, the distance of a pass has a sigma of {} m by that message alone; boundary_sigma_m asks for {} m. {}</source>
        <translation>Při {} a zprávě auta každých {} s má vzdálenost průjezdu už jen kvůli této zprávě sigma {} m; boundary_sigma_m žádá {} m. {}</translation>
    </message>
    <message>
        <location filename="../texts/passes.py" line="5"/>
        <source>Pass at {}.</source>
        <translation>Projíždějte rychlostí {}.</translation>
    </message>
    <message>
        <location filename="../texts/passes.py" line="5"/>
        <source>Ask for {} m, and pass at {}.</source>
        <translation>Žádejte {} m a projíždějte rychlostí {}.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>A test that has measured nothing cannot be compared.</source>
        <translation>Test, který nic nezměřil, nelze porovnat.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>The test in {} cannot be read: {}: {}</source>
        <translation>Test v {} nelze přečíst: {}: {}</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>The test does not start: the laboratory requires {}.</source>
        <translation>Test nezačne: laboratoř vyžaduje {}.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>The test was begun with another {}, {}; now it is {}. Continue it with that one, or begin a new test.</source>
        <translation>Test začal s jiným {}, {}; teď je to {}. Pokračujte s původním, nebo začněte nový test.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>The calibration of {} was valid until {}. Calibrate it again, or take another one.</source>
        <translation>Kalibrace {} platila do {}. Zkalibrujte znovu, nebo vezměte jiné měřidlo.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>{}{} is unknown; did you mean {}?</source>
        <translation>{}{} není známo; mělo to být {}?</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>{} is a number; write it in quotes, so that its zeros are kept.</source>
        <translation>{} je číslo; napište je do uvozovek, aby zůstaly nuly.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>{} has to be a text of at most {} characters in one line.</source>
        <translation>{} musí být text nejvýše {} znaků na jednom řádku.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>notes has to be a text of at most {} characters.</source>
        <translation>notes musí být text nejvýše {} znaků.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>{} has to be a list of at most {} entries.</source>
        <translation>{} musí být seznam nejvýše {} položek.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>{}name is missing.</source>
        <translation>{}chybí name.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>{}valid_until, {}, is before calibrated, {}.</source>
        <translation>{}valid_until, {}, je před calibrated, {}.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>{} has to be a day such as 2026-03-01.</source>
        <translation>{} musí být den, např. 2026-03-01.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>photos has to be a list of files with name and sha256.</source>
        <translation>photos musí být seznam souborů s name a sha256.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>photos has to be a list of at most {} paths.</source>
        <translation>photos musí být seznam nejvýše {} cest.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>equipment {}: it has {} parts between semicolons; allowed are name; serial number; calibrated; valid until.</source>
        <translation>měřidlo {}: má {} částí mezi středníky; smí být název; výrobní číslo; kalibrováno; platí do.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>required has to be a list of keys, such as [car_vin, operator].</source>
        <translation>required musí být seznam klíčů, např. [car_vin, operator].</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>key_battery_v is no number; allowed is 0 to 60 V.</source>
        <translation>key_battery_v není číslo; povoleno je 0 až 60 V.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>key_battery_v is {} V; allowed is 0 to 60 V.</source>
        <translation>key_battery_v je {} V; povoleno je 0 až 60 V.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>There are {} photos; at most {} are kept with a test.</source>
        <translation>Fotografií je {}; s testem se jich uchová nejvýše {}.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>The file {} is no photo; kept are {}.</source>
        <translation>Soubor {} není fotografie; uchovávají se {}.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>The photo {} cannot be read: {}.</source>
        <translation>Fotografii {} nelze přečíst: {}.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>The photo {} is no file of at most {} MiB.</source>
        <translation>Fotografie {} není soubor nejvýše {} MiB.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>The photo {} cannot be copied: {}.</source>
        <translation>Fotografii {} nelze zkopírovat: {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Without length and width of the Car&apos;s data sheet the distances may be up to {} cm too long: the Car may be wider above the height at which the LiDARs see it. Start the robot with car_file, and map the Car again.</source>
        <translation>Bez délky a šířky z technického listu auta mohou být vzdálenosti až o {} cm delší: nad výškou, ve které auto vidí LiDARy, může být širší. Spusťte robot s car_file a zmapujte auto znovu.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>The robot&apos;s {} was measured {} days ago; it was valid for {} days. Calibrate the robot again.</source>
        <translation>Hodnota {} robotu byla změřena před {} dny; platila {} dní. Robot znovu zkalibrujte.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>checks has to be a list of at most {} entries.</source>
        <translation>checks musí být seznam nejvýše {} položek.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>Parameter press_strength is {}; at the calibration of {} the Car answered from {} on. Press at least as strongly, or calibrate again.</source>
        <translation>Parametr press_strength je {}; při kalibraci {} auto odpovídalo od {}. Tiskněte alespoň takovou silou, nebo kalibrujte znovu.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>There are {} readings; give at least {}.</source>
        <translation>Počet odečtů je {}; zadejte alespoň {}.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>There are {} readings to the front axle and {} to the rear one; give as many of both.</source>
        <translation>Počet odečtů k přední nápravě je {} a k zadní {}; zadejte k oběma stejně.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>The readings differ by {} mm; allowed is {} mm. Read them again.</source>
        <translation>Odečty se liší o {} mm; povoleno je {} mm. Odečtěte je znovu.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>The distance between the axles differs by {} mm between the readings; allowed is {} mm. Read them again.</source>
        <translation>Vzdálenost náprav se mezi odečty liší o {} mm; povoleno je {} mm. Odečtěte je znovu.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>The heights are {} cm apart; give some that are at least {} cm apart.</source>
        <translation>Výšky jsou od sebe {} cm; zadejte takové, které jsou od sebe alespoň {} cm.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The {} port {} is open, but not the robot&apos;s; subscriber and publisher port may be swapped, the robot&apos;s link may be encrypted, or another program listens there.</source>
        <translation>Port {} {} je otevřený, ale nepatří robotu; porty mohou být prohozené, spojení robotu může být šifrované, nebo tam naslouchá jiný program.</translation>
    </message>
    <message>
        <location filename="../texts/pairing.py" line="5"/>
        <source>This laptop is not paired with the robot at {}; have the robot show a code, and type it here, or say mtr-operator pair.</source>
        <translation>Tento notebook není spárován s robotem na adrese {}; nechte robot zobrazit kód a zadejte ho zde, nebo spusťte mtr-operator pair.</translation>
    </message>
    <message>
        <location filename="../texts/pairing.py" line="5"/>
        <source>The robot does not know this laptop&apos;s key, or it was revoked; pair them again.</source>
        <translation>Robot nezná klíč tohoto notebooku, nebo byl klíč zneplatněn; spárujte je znovu.</translation>
    </message>
    <message>
        <location filename="../texts/pairing.py" line="5"/>
        <source>On the {} port {} is not the robot that was paired: it may be another one, its link may not be encrypted, or the ports may be swapped.</source>
        <translation>Na portu {} {} není spárovaný robot: může to být jiný, jeho spojení nemusí být šifrované, nebo jsou porty prohozené.</translation>
    </message>
    <message>
        <location filename="../texts/pairing.py" line="5"/>
        <source>This laptop is paired as a viewer: it sees the robot and cannot move it.</source>
        <translation>Tento notebook je spárován jen ke sledování: robot vidí, ale nemůže s ním pohnout.</translation>
    </message>
    <message>
        <location filename="../texts/pairing.py" line="5"/>
        <source>The list of paired robots {} is damaged; delete it and pair anew.</source>
        <translation>Seznam spárovaných robotů {} je poškozený; smažte ho a spárujte znovu.</translation>
    </message>
    <message>
        <location filename="../texts/pairing.py" line="5"/>
        <source>The list of paired robots cannot be written to {}: {}.</source>
        <translation>Seznam spárovaných robotů nelze zapsat do {}: {}.</translation>
    </message>
    <message>
        <location filename="../texts/pairing.py" line="5"/>
        <source>The robot at {} does not pair now; have it show a new code.</source>
        <translation>Robot na adrese {} teď nepáruje; nechte ho zobrazit nový kód.</translation>
    </message>
    <message>
        <location filename="../texts/pairing.py" line="5"/>
        <source>The robot at {} does not pair on port {}; have it show a code first (rosrun mtr_dispatcher pair).</source>
        <translation>Robot na adrese {} na portu {} nepáruje; nechte ho nejprve zobrazit kód (rosrun mtr_dispatcher pair).</translation>
    </message>
    <message>
        <location filename="../texts/pairing.py" line="5"/>
        <source>The code is wrong; the robot allows a few tries, each a little later.</source>
        <translation>Kód je chybný; robot dovolí několik pokusů, každý o něco později.</translation>
    </message>
    <message>
        <location filename="../texts/pairing.py" line="5"/>
        <source>The code has {} digits; the robot shows it.</source>
        <translation>Kód má {} číslic; zobrazuje ho robot.</translation>
    </message>
    <message>
        <location filename="../texts/pairing.py" line="5"/>
        <source>The robot&apos;s answer does not fit the code; begin anew with a new code.</source>
        <translation>Odpověď robotu neodpovídá kódu; začněte znovu s novým kódem.</translation>
    </message>
    <message>
        <location filename="../texts/pairing.py" line="5"/>
        <source>What has come is no message of a pairing.</source>
        <translation>Co přišlo, není zpráva párování.</translation>
    </message>
    <message>
        <location filename="../texts/pairing.py" line="5"/>
        <source>Pairing needs the Python package spake2: apt install python3-spake2, or pip install spake2.</source>
        <translation>Párování potřebuje balíček Pythonu spake2: apt install python3-spake2, nebo pip install spake2.</translation>
    </message>
    <message>
        <location filename="../texts/pairing.py" line="5"/>
        <source>The folder {} of the link&apos;s keys cannot be made: {}.</source>
        <translation>Složku {} pro klíče spojení nelze vytvořit: {}.</translation>
    </message>
    <message>
        <location filename="../texts/pairing.py" line="5"/>
        <source>The link&apos;s keys cannot be written to {}: {}.</source>
        <translation>Klíče spojení nelze zapsat do {}: {}.</translation>
    </message>
    <message>
        <location filename="../texts/pairing.py" line="5"/>
        <source>The link&apos;s keys in {} cannot be read: {}.</source>
        <translation>Klíče spojení v {} nelze přečíst: {}.</translation>
    </message>
    <message>
        <location filename="../texts/pairing.py" line="5"/>
        <source>The link&apos;s keys in {} are damaged; delete the file and pair anew.</source>
        <translation>Klíče spojení v {} jsou poškozené; smažte soubor a spárujte znovu.</translation>
    </message>
    <message>
        <location filename="../texts/pairing.py" line="5"/>
        <source>Others may read the secret key in {}; say chmod 600 {}, or delete it and pair anew.</source>
        <translation>Tajný klíč v {} mohou číst i jiní; spusťte chmod 600 {}, nebo ho smažte a spárujte znovu.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>the adapter&apos;s clock</source>
        <translation>hodiny adaptéru</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>the kernel&apos;s clock</source>
        <translation>hodiny jádra systému</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>this computer&apos;s clock when they are read</source>
        <translation>hodiny tohoto počítače při čtení</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>CAN FD data bit rate is {}; allowed is {}, the bit rate, to {} bit/s.</source>
        <translation>Rychlost dat CAN FD je {}; povoleno je {}, tedy rychlost sběrnice, až {} bit/s.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>python-can&apos;s driver {} cannot open an adapter so that it only listens; use one of {}, or choose normal mode (--can-normal) for a bench of one node.</source>
        <translation>Ovladač {} knihovny python-can neumí otevřít adaptér tak, aby jen naslouchal; použijte některý z {}, nebo zvolte normální režim (--can-normal) pro stůl s jedním uzlem.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>python-can&apos;s driver {} has no CAN FD; use one of {}, or leave the data bit rate out for classic CAN.</source>
        <translation>Ovladač {} knihovny python-can nemá CAN FD; použijte některý z {}, nebo pro klasickou CAN rychlost dat vynechejte.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>Whether the CAN interface {} only listens is not known, for the program ip does not tell; see that it is there and up, install iproute2, or choose normal mode (--can-normal) for a bench of one node.</source>
        <translation>Není známo, zda rozhraní CAN {} jen naslouchá, protože program ip to neříká; ověřte, že existuje a je zapnuté, nainstalujte iproute2, nebo zvolte normální režim (--can-normal) pro stůl s jedním uzlem.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>The CAN interface {} takes part in the bus; have it only listen by {}, or choose normal mode (--can-normal) for a bench of one node.</source>
        <translation>Rozhraní CAN {} se účastní sběrnice; nechte ho jen naslouchat pomocí {}, nebo zvolte normální režim (--can-normal) pro stůl s jedním uzlem.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>The CAN interface {} runs at {} bit/s, and {} bit/s is chosen; set one of them as the Car&apos;s bus is.</source>
        <translation>Rozhraní CAN {} běží rychlostí {} bit/s, zvoleno je {} bit/s; nastavte jedno z nich podle sběrnice auta.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>The CAN adapter has lost frames: they were not read in time; end other programs, or use an adapter with more room for them.</source>
        <translation>Adaptér CAN ztratil rámce: nebyly přečteny včas; ukončete jiné programy, nebo použijte adaptér s větší pamětí.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>The Car&apos;s bus carries CAN FD frames, and the adapter was opened for classic CAN; give the data bit rate of the bus.</source>
        <translation>Na sběrnici auta jsou rámce CAN FD a adaptér byl otevřen pro klasickou CAN; zadejte rychlost dat sběrnice.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>The CAN bus brings error frames ({}) and not one frame at {} bit/s: the bit rate is another one, or the bus carries CAN FD.</source>
        <translation>Ze sběrnice CAN přicházejí chybové rámce ({}) a ani jeden rámec při {} bit/s: rychlost je jiná, nebo sběrnice používá CAN FD.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>The car&apos;s profile names an output that takes the handle, and the CAN adapter only listens: a person takes it; choose normal mode (--can-normal) to have it switched.</source>
        <translation>Profil auta uvádí výstup, který bere za kliku, a adaptér CAN jen naslouchá: vezme za ni člověk; k ovládání výstupu zvolte normální režim (--can-normal).</translation>
    </message>
    <message>
        <location filename="../texts/learn.py" line="5"/>
        <source>The number of prompts is {}; allowed are even numbers from {} to {}.</source>
        <translation>Počet výzev je {}; povolena jsou sudá čísla od {} do {}.</translation>
    </message>
    <message>
        <location filename="../texts/learn.py" line="5"/>
        <source>Nothing came over the bus; check bit rate, plug and whether the Car is awake.</source>
        <translation>Po sběrnici nic nepřišlo; zkontrolujte přenosovou rychlost, konektor a zda auto nespí.</translation>
    </message>
    <message>
        <location filename="../texts/learn.py" line="5"/>
        <source>Nothing came over the bus in {} s; check bit rate, plug and whether the Car is awake.</source>
        <translation>Po sběrnici za {} s nic nepřišlo; zkontrolujte přenosovou rychlost, konektor a zda auto nespí.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>Message {} of CAN database {} cannot be used: {}.</source>
        <translation>Zprávu {} databáze CAN {} nelze použít: {}.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>Signal {} of message {} of CAN database {} cannot be used: {}.</source>
        <translation>Signál {} zprávy {} databáze CAN {} nelze použít: {}.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>Car profile {}: {} is {}; allowed are the lowest and the highest value of the counter, such as [0, {}], up to {}.</source>
        <translation>Profil auta {}: {} je {}; povolena je nejnižší a nejvyšší hodnota čítače, například [0, {}], nejvýše {}.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>Car profile {}: states names values for locked and unlocked that the signal {} of {} bits cannot carry.</source>
        <translation>Profil auta {}: states uvádí pro zamčeno a odemčeno hodnoty, které signál {} o {} bitech nemůže mít.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>Car profile {}: {} has {} and {}, which are the same bits, with two meanings.</source>
        <translation>Profil auta {}: {} má {} a {}, což jsou tytéž bity, se dvěma významy.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>Car profile {}: no signal can carry a value that states lists as {}.</source>
        <translation>Profil auta {}: žádný signál nemůže mít hodnotu, kterou states uvádí jako {}.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>Car profile {}: {} belongs to {}, which is missing.</source>
        <translation>Profil auta {}: {} patří k {}, což chybí.</translation>
    </message>
    <message>
        <location filename="../texts/learn.py" line="5"/>
        <source>The profile {} was written, and does not understand {} of the {} frames from which it was learned; learn again with more prompts.</source>
        <translation>Profil {} byl zapsán a nerozumí {} z {} rámců, ze kterých se učil; opakujte učení s více výzvami.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>{} is no CAN log: {}</source>
        <translation>{} není záznam CAN: {}</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>The CAN log {} names the buses {}, and only names with different numbers, such as can0 and can1, say which is which.</source>
        <translation>Záznam CAN {} uvádí sběrnice {}, a jen názvy s různými čísly, například can0 a can1, říkají, která je která.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>A CAN log of the format {} holds no CAN FD frame; choose blf or asc (--can-log-format).</source>
        <translation>Záznam CAN ve formátu {} neobsáhne rámce CAN FD; zvolte blf nebo asc (--can-log-format).</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>The CAN log {} holds no frame that is understood: {}.</source>
        <translation>Záznam CAN {} neobsahuje srozumitelný rámec: {}.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>The CAN log {} holds no frame: {}; read are {}.</source>
        <translation>Záznam CAN {} neobsahuje žádný rámec: {}; čtou se {}.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>Car profile {}: {} belongs to {}, which is missing or false.</source>
        <translation>Profil auta {}: {} patří k {}, což chybí nebo je false.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>Car profile {}: {} is {}, which is only sent on change; name another message.</source>
        <translation>Profil auta {}: {} je {}, která se posílá jen při změně; uveďte jinou zprávu.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>Message {} (id 0x{}) comes on the bus of the state and on the bus {}; that of the first one counts. Check that the adapters are at the buses that the profile names.</source>
        <translation>Zpráva {} (id 0x{}) přichází na sběrnici stavu i na sběrnici {}; platí ta z první. Zkontrolujte, zda jsou adaptéry na sběrnicích, které profil uvádí.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>Message {} (id 0x{}) comes on several channels of the log, {} among them, and the car profile does not say which is which; name the further buses (buses).</source>
        <translation>Zpráva {} (id 0x{}) přichází na více kanálech záznamu, mezi nimi {}, a profil auta neříká, který je který; uveďte další sběrnice (buses).</translation>
    </message>
    <message>
        <location filename="../texts/learn.py" line="5"/>
        <source>No bit of any message followed all prompts; repeat it, and act only when asked. A Car that tells its locks on another bus cannot be learned from this one.</source>
        <translation>Žádný bit žádné zprávy neodpovídal všem výzvám; opakujte to a jednejte jen na výzvu. Auto, které o zámcích vypovídá na jiné sběrnici, se z této naučit nelze.</translation>
    </message>
    <message>
        <location filename="../texts/learn.py" line="5"/>
        <source>The profile is called {}; allowed are letters, digits, - and _, and .yaml at the end.</source>
        <translation>Profil se jmenuje {}; povolena jsou písmena, číslice, - a _ a na konci .yaml.</translation>
    </message>
    <message>
        <location filename="../texts/learn.py" line="5"/>
        <source>The file {} is there already; choose another name.</source>
        <translation>Soubor {} již existuje; zvolte jiný název.</translation>
    </message>
    <message>
        <location filename="../texts/learn.py" line="5"/>
        <source>The input has ended before all prompts were answered; learn needs a terminal.</source>
        <translation>Vstup skončil dříve, než byly zodpovězeny všechny výzvy; learn potřebuje terminál.</translation>
    </message>
    <message>
        <location filename="../texts/learn.py" line="5"/>
        <source>{} more messages followed all prompts as well, such as lights or mirrors; the one that came first is proposed. Compare it with the Car&apos;s documents.</source>
        <translation>Všem výzvám odpovídaly také další zprávy ({}), například světla nebo zrcátka; navržena je ta, která přišla první. Porovnejte ji s dokumentací auta.</translation>
    </message>
    <message>
        <location filename="../texts/learn.py" line="5"/>
        <source>If what stands still between the prompts were chance, {} bits would follow all of them; more prompts make it surer.</source>
        <translation>Kdyby to, co se mezi výzvami nemění, bylo náhodné, odpovídalo by všem výzvám {} bitů; více výzev dá větší jistotu.</translation>
    </message>
    <message>
        <location filename="../texts/learn.py" line="5"/>
        <source>What is proposed also changed when nobody was asked to act; repeat it, and act only when asked.</source>
        <translation>Navržené se měnilo i tehdy, když nikdo nebyl vyzván; opakujte to a jednejte jen na výzvu.</translation>
    </message>
    <message>
        <location filename="../texts/learn.py" line="5"/>
        <source>counter {}</source>
        <translation>čítač {}</translation>
    </message>
    <message>
        <location filename="../texts/learn.py" line="5"/>
        <source>counts changes {}</source>
        <translation>čítá změny {}</translation>
    </message>
    <message>
        <location filename="../texts/learn.py" line="5"/>
        <source>check sum in byte {}</source>
        <translation>kontrolní součet v bajtu {}</translation>
    </message>
    <message>
        <location filename="../texts/learn.py" line="5"/>
        <source>{} more changes</source>
        <translation>dalších změn: {}</translation>
    </message>
    <message>
        <location filename="../texts/learn.py" line="5"/>
        <source>not cyclic</source>
        <translation>není periodická</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>A CAN log of the format mf4 needs the Python package asammdf, which is not installed; install it, or choose blf.</source>
        <translation>Záznam CAN ve formátu mf4 potřebuje balíček Pythonu asammdf, který není nainstalován; nainstalujte ho, nebo zvolte blf.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>The CAN log {} cannot be written: {}.</source>
        <translation>Záznam CAN {} nelze zapsat: {}.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>The CAN log {} cannot be read: {}.</source>
        <translation>Záznam CAN {} nelze přečíst: {}.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>The CAN log {} needs the Python package asammdf, which is not installed.</source>
        <translation>Záznam CAN {} potřebuje balíček Pythonu asammdf, který není nainstalován.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>The CAN log {} cannot be read: it is damaged or of another format.</source>
        <translation>Záznam CAN {} nelze přečíst: je poškozený nebo v jiném formátu.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>The CAN log {} holds no frame.</source>
        <translation>Záznam CAN {} neobsahuje žádný rámec.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>The CAN log {} has come to its end.</source>
        <translation>Záznam CAN {} skončil.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>The CAN log is not open.</source>
        <translation>Záznam CAN není otevřen.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>The course {} cannot be read: {}.</source>
        <translation>Průběh {} nelze přečíst: {}.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>The course {} is damaged; it is no text.</source>
        <translation>Průběh {} je poškozený; není to text.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>The course {} is damaged in line {}, or of another version.</source>
        <translation>Průběh {} je poškozený na řádku {}, nebo v jiné verzi.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>Car profile {}: signal must be a name, or a table from the name of a door to its signal.</source>
        <translation>Profil auta {}: signal musí být název, nebo tabulka od názvu dveří k jejich signálu.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>Car profile {}: buses must be a table from the name of a further bus to its CAN database.</source>
        <translation>Profil auta {}: buses musí být tabulka od názvu další sběrnice k její databázi CAN.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>Car profile {}: doors must be a table from the name of a door to its signal.</source>
        <translation>Profil auta {}: doors musí být tabulka od názvu dveří k jejich signálu.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>Car profile {}: {} must be a list of tables.</source>
        <translation>Profil auta {}: {} musí být seznam tabulek.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>Car profile {}: {} names the bus {}, which is not in buses.</source>
        <translation>Profil auta {}: {} uvádí sběrnici {}, která není v buses.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>Car profile {}: {} is on the bus {} and names no message.</source>
        <translation>Profil auta {}: {} je na sběrnici {} a neuvádí zprávu.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>Car profile {}: {} has {}: {}; allowed is a whole number.</source>
        <translation>Profil auta {}: {} má {}: {}; povoleno je celé číslo.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>Car profile {}: {} has {}: {}; allowed is a list of whole numbers.</source>
        <translation>Profil auta {}: {} má {}: {}; povolen je seznam celých čísel.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>Car profile {}: uds_poll must be a table of {}; needed are {}.</source>
        <translation>Profil auta {}: uds_poll musí být tabulka s položkami {}; nutné jsou {}.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>Car profile {}: uds_poll has {}: {}; allowed is {} to {}.</source>
        <translation>Profil auta {}: uds_poll má {}: {}; povoleno je {} až {}.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>Car profile {}: {} must be a table of {}.</source>
        <translation>Profil auta {}: {} musí být tabulka s položkami {}.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>The car profile {} asks the Car for its lock state (uds_poll), and the CAN adapter only listens; choose normal mode (--can-normal) where the Car may be asked, or a profile with a state that it sends.</source>
        <translation>Profil auta {} se auta ptá na stav zámků (uds_poll) a adaptér CAN jen poslouchá; zvolte normální režim (--can-normal) tam, kde je dovoleno se auta ptát, nebo profil se stavem, který auto vysílá.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>The car profile needs the bus {}, too; name its adapter (--can-bus {}=INTERFACE:CHANNEL:BITRATE).</source>
        <translation>Profil auta potřebuje i sběrnici {}; uveďte její adaptér (--can-bus {}=INTERFACE:CHANNEL:BITRATE).</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>Further bus {}: {}</source>
        <translation>Další sběrnice {}: {}</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>Message {} comes every {} s, and {} says {} s; the uncertainty of a change rests on it: correct it.</source>
        <translation>Zpráva {} přichází každých {} s a {} uvádí {} s; závisí na tom nejistota změny: opravte to.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>Message {} (id {}) comes without the signal {}: another page of a multiplexed message, or a shorter one than the database says; check the car profile.</source>
        <translation>Zpráva {} (id {}) přichází bez signálu {}: jiná stránka multiplexované zprávy, nebo zpráva kratší, než uvádí databáze; zkontrolujte profil auta.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>The signal {} of the Car&apos;s message {} went from {} to {}.</source>
        <translation>Signál {} zprávy auta {} přešel z {} na {}.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>The signal {} of the Car&apos;s message {} stands still at {}.</source>
        <translation>Signál {} zprávy auta {} stojí na {}.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>The Car&apos;s bus tells that {} is open; leave the Car&apos;s doors closed during the test.</source>
        <translation>Sběrnice auta hlásí, že je otevřeno: {}; během testu nechte dveře auta zavřené.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>The Car&apos;s bus names two causes of one change, {} and {}.</source>
        <translation>Sběrnice auta uvádí dvě příčiny jedné změny, {} a {}.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>The key with the number {} moved the Car&apos;s locks, and number {} is under test.</source>
        <translation>Zámky auta změnil klíč číslo {}, testuje se ale číslo {}.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>The Car&apos;s locks moved on its bus, and {} counted nothing.</source>
        <translation>Zámky auta se podle sběrnice změnily a {} nic nenapočítal.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>The Car&apos;s locks moved while {} was open.</source>
        <translation>Zámky auta se změnily, když bylo otevřeno: {}.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>The Car was {} by something that its profile does not list ({}), not by {}; leave its doors and switches alone during the test.</source>
        <translation>Stav auta („{}“) způsobilo něco, co profil auta neuvádí ({}), ne {}; během testu nesahejte na dveře ani spínače auta.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>The CAN log {} has a gap of {} s after {} frames; a change within it is as uncertain as the gap is long.</source>
        <translation>V záznamu CAN {} je mezera {} s po {} rámcích; změna v ní je nejistá po celou její délku.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>The time of the CAN log {} jumps back by {} s after {} frames; what lies about it is not to be believed.</source>
        <translation>Čas záznamu CAN {} skáče zpět o {} s po {} rámcích; údajům kolem tohoto místa nelze věřit.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The robot starts.</source>
        <translation>Robot se spouští.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The robot is ready to map the Car.</source>
        <translation>Robot je připraven zmapovat auto.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The robot maps the Car.</source>
        <translation>Robot mapuje auto.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The robot is ready to drive.</source>
        <translation>Robot je připraven k jízdě.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The robot has a fault.</source>
        <translation>Robot má poruchu.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The robot checks where the Car stands.</source>
        <translation>Robot ověřuje, kde auto stojí.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The robot was driven by hand.</source>
        <translation>Robot byl řízen ručně.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The lift was moved by hand.</source>
        <translation>Zdvihem bylo pohnuto ručně.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The path to the waypoint was planned anew.</source>
        <translation>Cesta k bodu byla naplánována znovu.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The robot stopped because something stood in its way, or because it saw nothing.</source>
        <translation>Robot zastavil, protože mu něco stálo v cestě nebo nic neviděl.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>A motion lock stopped the robot.</source>
        <translation>Robot byl zastaven zámkem pohybu.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The robot&apos;s peripherals started anew.</source>
        <translation>Periferie robotu se spustily znovu.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The robot&apos;s clock was set.</source>
        <translation>Hodiny robotu byly přestaveny.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The emergency stop is pressed.</source>
        <translation>Nouzové zastavení je stisknuto.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The emergency stop is released.</source>
        <translation>Nouzové zastavení je uvolněno.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The robot has no emergency stop that its software sees.</source>
        <translation>Robot nemá nouzové zastavení, které by jeho software viděl.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>Waypoint {} is reached.</source>
        <translation>Bod {} je dosažen.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>Waypoint {} is refused.</source>
        <translation>Bod {} je odmítnut.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>Something stands in the robot&apos;s way.</source>
        <translation>Robotu něco stojí v cestě.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The robot&apos;s way is free again.</source>
        <translation>Cesta robotu je opět volná.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The button was pressed for {} s.</source>
        <translation>Tlačítko bylo stisknuto {} s.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The Car stands where it was measured.</source>
        <translation>Auto stojí tam, kde bylo změřeno.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The Car does not stand where it was measured.</source>
        <translation>Auto nestojí tam, kde bylo změřeno.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The Car is found: {} m long, {} m wide.</source>
        <translation>Auto je nalezeno: délka {} m, šířka {} m.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The Car coordinate system was corrected by {} cm and {} degrees.</source>
        <translation>Souřadnicová soustava auta byla opravena o {} cm a {} stupňů.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>Another application controls the robot.</source>
        <translation>Robot ovládá jiná aplikace.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>No other application controls the robot any more.</source>
        <translation>Robot už žádná jiná aplikace neovládá.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The robot has started anew.</source>
        <translation>Robot se spustil znovu.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>Over: {}</source>
        <translation>Pominulo: {}</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The robot is not heard any more.</source>
        <translation>Robot už není slyšet.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The robot is heard again after {} s.</source>
        <translation>Robot je po {} s opět slyšet.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The Car is {} now.</source>
        <translation>Stav zámků auta: {}.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The Car is {} now ({}).</source>
        <translation>Stav zámků auta: {} (příčina: {}).</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>the key&apos;s vicinity</source>
        <translation>blízkost klíče</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>the key&apos;s button</source>
        <translation>tlačítko klíče</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>the handle</source>
        <translation>klika</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The test begins.</source>
        <translation>Test začíná.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The test goes on.</source>
        <translation>Test pokračuje.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The test is paused.</source>
        <translation>Test je pozastaven.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>All lines are measured.</source>
        <translation>Všechny přímky jsou změřeny.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>axis {} ({}): {}</source>
        <translation>osa {} ({}): {}</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>radial {} ({}): {}</source>
        <translation>paprsek {} ({}): {}</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>zone {} ({}): {}</source>
        <translation>zóna {} ({}): {}</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>measured</source>
        <translation>změřeno</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>Stop.</source>
        <translation>Zastavit.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>Go on.</source>
        <translation>Pokračovat.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The handle was taken.</source>
        <translation>Klika byla uchopena.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>Map the Car.</source>
        <translation>Zmapovat auto.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>Check where the Car stands.</source>
        <translation>Ověřit, kde auto stojí.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The event list {} holds {} entries; the rest is not kept.</source>
        <translation>Seznam událostí {} obsahuje {} záznamů; zbytek se neukládá.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The event list is not kept in {} any more: {}.</source>
        <translation>Seznam událostí se do {} už neukládá: {}.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The event list {} cannot be read: {}.</source>
        <translation>Seznam událostí {} nelze přečíst: {}.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>The event list {} is damaged in line {}, or of another version.</source>
        <translation>Seznam událostí {} je poškozen na řádku {}, nebo jiné verze.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>it is a pipe or a device, and no file</source>
        <translation>je to roura nebo zařízení, a ne soubor</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The folder {} cannot be read: {}.</source>
        <translation>Složku {} nelze přečíst: {}.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The test in {} cannot be read: {}.</source>
        <translation>Test v {} nelze přečíst: {}.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The folder {} holds {}, and no {}: what was measured can be read there, and is no test that can be opened.</source>
        <translation>Složka {} obsahuje {}, ale ne {}: co bylo změřeno, lze v ní přečíst, není to však test, který by šlo otevřít.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>{} is no file.</source>
        <translation>{} není soubor.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The bundle {} was written by a newer version of the application.</source>
        <translation>Balík {} zapsala novější verze aplikace.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The bundle {} holds no {}.</source>
        <translation>Balík {} neobsahuje {}.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The bundle {} cannot be unpacked: {}.</source>
        <translation>Balík {} nelze rozbalit: {}.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The bundle {} is not as it was signed. {}</source>
        <translation>Balík {} není takový, jak byl podepsán. {}</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>{} is torn, or no bundle: its list of files cannot be read.</source>
        <translation>{} je neúplný, nebo to není balíček: seznam jeho souborů nelze přečíst.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>There is no {} or {} in it: it is no bundle.</source>
        <translation>Chybí v něm {} nebo {}: není to balíček.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>{} or {} is changed: it cannot be read any more.</source>
        <translation>{} nebo {} je změněn: už jej nelze přečíst.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>{} or {} is changed: the signature is not that of the station&apos;s key over it.</source>
        <translation>{} nebo {} je změněn: podpis není podpisem klíče stanice.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>{} is missing.</source>
        <translation>{} chybí.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>{} is changed.</source>
        <translation>{} je změněn.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>{} was added.</source>
        <translation>{} byl přidán.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>A file is in it twice.</source>
        <translation>Některý soubor je v něm dvakrát.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The files are as they were signed, but the zip around them is not as it was written, from byte {} on: it was packed anew, or a byte between the files is changed.</source>
        <translation>Soubory jsou takové, jak byly podepsány, ale zip kolem nich není takový, jak byl zapsán, od bajtu {} dále: byl zabalen znovu, nebo je změněn bajt mezi soubory.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The laptop slept for {} s, and the robot stood meanwhile.</source>
        <translation>Notebook spal {} s a robot mezitím stál.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The application stood still for {} s, and the robot stood meanwhile.</source>
        <translation>Aplikace {} s neběžela a robot mezitím stál.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>{} The line at hand is measured anew when the test goes on.</source>
        <translation>{} Rozpracovaná přímka se změří znovu, až bude test pokračovat.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>position {} ({}, {} m)</source>
        <translation>poloha {} ({}, {} m)</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>Nothing tells the phone&apos;s distance: the Car&apos;s profile declares no phone_distance; add one to the profile, or name a feed (--phone-feed).</source>
        <translation>Vzdálenost telefonu nic nehlásí: profil auta neuvádí phone_distance; doplňte ji do profilu, nebo uveďte zdroj (--phone-feed).</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>Nothing tells the phone&apos;s distance any more: {}</source>
        <translation>Vzdálenost telefonu už nic nehlásí: {}</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>The phone&apos;s distance was told {} times within {} s; {} times are needed.</source>
        <translation>Vzdálenost telefonu byla hlášena {}krát za {} s; je třeba {}krát.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>The phone&apos;s distance did not change within {} s; {} changes are needed. Increase reading_time_s, or check the phone.</source>
        <translation>Vzdálenost telefonu se za {} s nezměnila; je třeba {} změn. Prodlužte reading_time_s, nebo zkontrolujte telefon.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>The phone&apos;s distance did not change more than once within {} s; {} changes are needed. Increase reading_time_s, or check the phone.</source>
        <translation>Vzdálenost telefonu se za {} s změnila jen jednou; je třeba {} změn. Prodlužte reading_time_s, nebo zkontrolujte telefon.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>The phone&apos;s distance did not change more than {} times within {} s; {} changes are needed. Increase reading_time_s, or check the phone.</source>
        <translation>Vzdálenost telefonu se změnila jen {}krát za {} s; je třeba {} změn. Prodlužte reading_time_s, nebo zkontrolujte telefon.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>The phone&apos;s distances scatter by {} m; their median is not known.</source>
        <translation>Vzdálenosti telefonu kolísají o {} m; jejich medián není znám.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>The clock of the phone&apos;s distance was set forward by {} s.</source>
        <translation>Hodiny vzdálenosti telefonu byly posunuty dopředu o {} s.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>The clock of the phone&apos;s distance was set back by {} s.</source>
        <translation>Hodiny vzdálenosti telefonu byly posunuty zpět o {} s.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>The newest distance of the phone was {} s old while it was read; allowed are {} s.</source>
        <translation>Nejnovější vzdálenost telefonu byla při čtení stará {} s; dovoleno je {} s.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>The phone&apos;s distance was {} m without any change at places {} and {} m away; the feed is frozen or at the end of its range.</source>
        <translation>Vzdálenost telefonu byla beze změny {} m na místech vzdálených {} a {} m; zdroj zamrzl, nebo je na konci svého rozsahu.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>The phone&apos;s distance, {} m, is off by {} m; that is none.</source>
        <translation>Vzdálenost telefonu, {} m, se liší o {} m; to žádná vzdálenost není.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>The phone is at the reference itself.</source>
        <translation>Telefon je přímo v místě, se kterým se porovnává.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>The robot moved while the phone&apos;s distance was read.</source>
        <translation>Robot se při čtení vzdálenosti telefonu pohnul.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>The robot does not say how sure it is of its position.</source>
        <translation>Robot neříká, jak jistou má svou polohu.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>The phone&apos;s distance cannot be read from {}: {}; start what sends it, or correct the feed&apos;s address.</source>
        <translation>Vzdálenost telefonu nelze číst ({}): {}; spusťte to, co ji posílá, nebo opravte adresu zdroje.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>The phone&apos;s distance does not come from {} any more: {}.</source>
        <translation>Vzdálenost telefonu už nepřichází ({}): {}.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>What comes from {} is no distance: {}</source>
        <translation>Co přichází ({}), není vzdálenost: {}</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>Nothing has come from {} since it was connected; see whether it sends a line for each distance.</source>
        <translation>Od připojení nic nepřišlo ({}); podívejte se, zda zdroj posílá pro každou vzdálenost řádek.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>Car profile {}: phone_distance must be tcp:HOST:PORT, serial:DEVICE:BAUD, or a table of {}.</source>
        <translation>Profil auta {}: phone_distance musí být tcp:HOST:PORT, serial:DEVICE:BAUD, nebo tabulka s položkami {}.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>Car profile {}: phone_distance names the bus {}, which is not in buses.</source>
        <translation>Profil auta {}: phone_distance uvádí sběrnici {}, která není v buses.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>Car profile {}: phone_distance needs the entry database.</source>
        <translation>Profil auta {}: phone_distance potřebuje položku database.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>Car profile {}: phone_distance has the unit {}; allowed is {}: name it (unit).</source>
        <translation>Profil auta {}: phone_distance má jednotku {}; dovoleno je {}: uveďte ji (unit).</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>Car profile {}: phone_distance has no_distance: {}; allowed is a list of whole numbers.</source>
        <translation>Profil auta {}: phone_distance má no_distance: {}; dovolen je seznam celých čísel.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>Car profile {}: phone_distance is {}; a simulated phone is for the command line (--phone-feed).</source>
        <translation>Profil auta {}: phone_distance je {}; simulovaný telefon je jen pro příkazovou řádku (--phone-feed).</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>Parameter minimum_distance_m is {} m; it has to be at most maximum_distance_m, {} m.</source>
        <translation>Parametr minimum_distance_m je {} m; smí být nejvýše maximum_distance_m, {} m.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>Parameter maximum_age_s is {} s; it has to be at most reading_time_s, {} s.</source>
        <translation>Parametr maximum_age_s je {} s; smí být nejvýše reading_time_s, {} s.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>Beside each distance that the phone told stands 1 sigma of where it really was, and the 95 % interval of what it told there; the errors are in results.csv.</source>
        <translation>Vedle každé vzdálenosti, kterou telefon hlásil, stojí 1 sigma toho, kde skutečně byl, a 95% interval toho, co tam hlásil; chyby jsou v results.csv.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>The feed of the phone&apos;s distance is {}; allowed is {}.</source>
        <translation>Zdroj vzdálenosti telefonu je {}; dovoleno je {}.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>The {} of the phone&apos;s feed is {}; allowed is {} to {}.</source>
        <translation>{} zdroje telefonu: {}; dovoleno je {} až {}.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>A simulated phone has no {}; allowed are {}.</source>
        <translation>Simulovaný telefon nemá {}; dovoleno je {}.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>{} of a simulated phone is {}; allowed is a number.</source>
        <translation>{} simulovaného telefonu je {}; dovoleno je číslo.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>nobody has answered for {} s</source>
        <translation>nikdo neodpověděl po {} s</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>it is not connected</source>
        <translation>není připojen</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>it is not open</source>
        <translation>není otevřena</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>the other side has closed the connection</source>
        <translation>druhá strana ukončila spojení</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The bundle {} was not written as it was signed: {} Check the disk, and write it again.</source>
        <translation>Balík {} není zapsán tak, jak byl podepsán: {} Zkontrolujte disk a zapište jej znovu.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The bundle {} cannot be written: {}.</source>
        <translation>Balíček {} nelze zapsat: {}.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The bundle was given up, for the window closes.</source>
        <translation>Balíček se nedokončil, protože se okno zavírá.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The chain of bundles in {} is damaged; move that file elsewhere to begin a new chain.</source>
        <translation>Řetěz balíčků v {} je poškozený; přesuňte tento soubor jinam, a začne nový řetěz.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The key of this station in {} cannot be read or made: {}.</source>
        <translation>Klíč této stanice v {} nelze přečíst ani vytvořit: {}.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The key of this station in {} is damaged; restore it from a copy, or move it elsewhere to have a new one made.</source>
        <translation>Klíč této stanice v {} je poškozený; obnovte jej z kopie, nebo jej přesuňte jinam, a vytvoří se nový.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The package duckdb is not installed; pip install duckdb, then bundle the test anew.</source>
        <translation>Balík duckdb není nainstalován; zadejte pip install duckdb a uložte balíček znovu.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>It cannot be made: {}</source>
        <translation>Nelze vytvořit: {}</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The scans {} are damaged in line {}, or of another version.</source>
        <translation>Skeny {} jsou poškozené na řádku {}, nebo jsou jiné verze.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The scans {} cannot be read: {}.</source>
        <translation>Skeny {} nelze přečíst: {}.</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>trial {}: the key is held still for {} s</source>
        <translation>pokus {}: klíč se drží v klidu {} s</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>a trial was disturbed and is made again</source>
        <translation>pokus byl narušen a opakuje se</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>move the key: it has to answer then</source>
        <translation>pohnout klíčem: pak musí odpovědět</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>asleep after {} to {} s</source>
        <translation>usne po {} až {} s</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>asleep after {} s at most</source>
        <translation>usne nejpozději po {} s</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>awake for at least {} s</source>
        <translation>bdí nejméně {} s</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>The Remote key was moved while it was to be held still.</source>
        <translation>Klíčem se pohnulo, když měl být držen v klidu.</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>Nobody knows since when the Remote key has been at rest.</source>
        <translation>Není známo, od kdy je klíč v klidu.</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>The key did not answer {} requests at {} m right after it was moved: the place lies outside the zone, the key&apos;s battery is empty, it is not the Car&apos;s key, or the handle of this side was not taken.</source>
        <translation>Klíč neodpověděl na {} dotazů ve vzdálenosti {} m hned poté, co se jím pohnulo: místo leží mimo zónu, klíč má prázdnou baterii, není to klíč tohoto auta, nebo se za kliku na této straně nevzalo.</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>Parameter wake_move_m is {} m; allowed is at most {} m, up to maximum_distance_m.</source>
        <translation>Parametr wake_move_m je {} m; povoleno je nejvýše {} m, po maximum_distance_m.</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>Parameter interval_s is {} s; allowed is more than {} s, for the requests to a silent key take half of that; decrease requests or response_timeout_s.</source>
        <translation>Parametr interval_s je {} s; povoleno je více než {} s, protože dotazy na mlčící klíč trvají polovinu toho; zmenšete requests nebo response_timeout_s.</translation>
    </message>
    <message>
        <location filename="../texts/handle.py" line="5"/>
        <source>Parameter longest_wait_s is {} s; it has to be longer than shortest_wait_s, {} s.</source>
        <translation>Parametr longest_wait_s je {} s; musí být delší než shortest_wait_s, {} s.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>The CAN adapter {} ({}) is that of another bus already; give each bus an adapter of its own.</source>
        <translation>Adaptér CAN {} ({}) už patří jiné sběrnici; dejte každé sběrnici vlastní adaptér.</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="5"/>
        <source>switch the extender off</source>
        <translation>vypnout extender</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="5"/>
        <source>switch the extender on</source>
        <translation>zapnout extender</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="5"/>
        <source>The extender was switched off.</source>
        <translation>Extender byl vypnut.</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="5"/>
        <source>The extender was switched on.</source>
        <translation>Extender byl zapnut.</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="5"/>
        <source>handle request at {} m: the Car has to unlock there</source>
        <translation>uchopení kliky ve vzdálenosti {} m: auto se tam musí odemknout</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="5"/>
        <source>handle request at {} m, extender off</source>
        <translation>uchopení kliky ve vzdálenosti {} m, extender vypnut</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="5"/>
        <source>handle request at {} m, extender on</source>
        <translation>uchopení kliky ve vzdálenosti {} m, extender zapnut</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="5"/>
        <source>not resistant: with the extender {} of {} unlocked, up to {} m</source>
        <translation>neodolné: s extenderem odemklo {} z {}, až do {} m</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="5"/>
        <source>resistant but for at most {} % (95 %): with the extender {} of {} unlocked</source>
        <translation>odolné až na nejvýše {} % (95 %): s extenderem odemklo {} z {}</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="5"/>
        <source>zone beyond its border: without the extender {} of {} unlocked, up to {} m</source>
        <translation>zóna za svou hranicí: bez extenderu odemklo {} z {}, až do {} m</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="5"/>
        <source>Nobody switches the extender: the Car&apos;s profile declares no extender_switch, and there is no Operator to ask; add one to the profile, or start the test where a person can answer.</source>
        <translation>Nikdo nepřepíná extender: profil auta neuvádí extender_switch a není tu obsluha, které by se dalo říci; doplňte jej do profilu, nebo spusťte test tam, kde může někdo odpovědět.</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="5"/>
        <source>Nobody has switched the extender within {} s; continue the test when somebody is there to do it, or increase switch_timeout_s.</source>
        <translation>Během {} s nikdo nepřepnul extender; pokračujte v testu, až tu bude někdo, kdo to udělá, nebo zvětšete switch_timeout_s.</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="5"/>
        <source>The Car did not unlock at {} requests at {} m, inside its zone: the key sleeps, its battery is empty, it is not the Car&apos;s key, or the handle of this side was not taken; its silence beyond the border says nothing.</source>
        <translation>Auto se neodemklo při {} uchopeních kliky ve vzdálenosti {} m, uvnitř své zóny: klíč spí, má vybitou baterii, není to klíč tohoto auta, nebo se neuchopila klika této strany; jeho mlčení za hranicí nic neříká.</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="5"/>
        <source>The Remote key was at {} m, with 1 sigma of {} m: not surely beyond the nominal border at {} m.</source>
        <translation>Klíč byl ve vzdálenosti {} m s 1 sigma {} m: není jisté, že za jmenovitou hranicí {} m.</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="5"/>
        <source>Parameter minimum_distance_m is {} m; it has to be at most border_distance_m, {} m.</source>
        <translation>Parametr minimum_distance_m je {} m; smí být nejvýše border_distance_m, {} m.</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="5"/>
        <source>Parameter places_m has {} m; allowed is {} m, which is {} m beyond border_distance_m, to {} m, maximum_distance_m.</source>
        <translation>Parametr places_m obsahuje {} m; dovoleno je od {} m, což je {} m za border_distance_m, do {} m, maximum_distance_m.</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="5"/>
        <source>Car profile {}: extender_switch must be a table of {}.</source>
        <translation>Profil auta {}: extender_switch musí být tabulka s klíči {}.</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="5"/>
        <source>Car profile {}: extender_switch has {}: {}; allowed is a whole number.</source>
        <translation>Profil auta {}: extender_switch má {}: {}; dovoleno je celé číslo.</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="5"/>
        <source>Car profile {}: {} and {} of {} are both {}; give two values.</source>
        <translation>Profil auta {}: {} a {} v {} jsou obě {}; uveďte dvě hodnoty.</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="5"/>
        <source>The car&apos;s profile names an output that switches the extender, and the CAN adapter only listens: a person switches it; choose normal mode (--can-normal) to have it switched.</source>
        <translation>Profil auta uvádí výstup, který přepíná extender, a adaptér CAN jen poslouchá: přepne jej člověk; zvolte normální režim (--can-normal), aby se přepínal sám.</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="5"/>
        <source>The Car did not unlock inside its zone, so that its silence beyond the border says nothing.</source>
        <translation>Auto se uvnitř své zóny neodemklo, takže jeho mlčení za hranicí nic neříká.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>Skip line {}.</source>
        <translation>Přeskočit přímku {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The line was skipped by the Operator.</source>
        <translation>Přímku přeskočila obsluha.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The test in {} does not say which car profile it had; name one (--car-profile).</source>
        <translation>Test v {} neříká, jaký profil auta měl; uveďte jej (--car-profile).</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>There is no recording of the test in {}; tests of this version and later have one.</source>
        <translation>V {} není záznam testu; mají jej testy od této verze.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>Of {} lines nothing was recorded ({}).</source>
        <translation>O {} přímkách není nic zaznamenáno ({}).</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot had a fault: {}</source>
        <translation>Robot měl poruchu: {}</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>{}it needs either at_least_m or at_most_m; or, of what is no distance, one of {}.</source>
        <translation>{}je potřeba buď at_least_m, nebo at_most_m; u toho, co není vzdálenost, jedno z {}.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>{}share_percent is for distances; leave it out beside {}.</source>
        <translation>{}share_percent je pro vzdálenosti; u {} jej vynechte.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>Limit {}: it is at {} {}, and with these parameters only one from {} to {} {} can be judged.</source>
        <translation>Mez {}: leží na {} {}, a s těmito parametry lze posoudit jen mez od {} do {} {}.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>Limit {}: {} is limited by {}, not by {}.</source>
        <translation>Mez {}: {} se omezuje pomocí {}, ne pomocí {}.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>{} at most {} s</source>
        <translation>{} nejvýše {} s</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>{} at least {} s</source>
        <translation>{} alespoň {} s</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>{} at most {} m</source>
        <translation>{} nejvýše {} m</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>{} at most {} %</source>
        <translation>{} nejvýše {} %</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>is below {} s</source>
        <translation>je pod {} s</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>is above {} s</source>
        <translation>je nad {} s</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>lies between {} and {} s</source>
        <translation>leží mezi {} a {} s</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>lies between {} and {} %</source>
        <translation>leží mezi {} a {} %</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>The line does not tell this.</source>
        <translation>Přímka to neuvádí.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>{} tests fit; at most {} are looked at together. Narrow the search.</source>
        <translation>Vyhovuje {} testů; společně se hodnotí nejvýše {}. Upřesněte hledání.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>Tests of the scenarios {} cannot be looked at together; choose one.</source>
        <translation>Testy scénářů {} nelze hodnotit společně; vyberte jeden.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>No test measured it.</source>
        <translation>Žádný test ji nezměřil.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>One test that does not say how sure it is.</source>
        <translation>Jediný test, který neříká, jak je jistý.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>{} tests have a value here; {} are the fewest.</source>
        <translation>Hodnotu zde má testů: {}; nejméně musí být {}.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>All tests have the same value.</source>
        <translation>Všechny testy mají stejnou hodnotu.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>No test fits.</source>
        <translation>Žádný test nevyhovuje.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The store {} is gone.</source>
        <translation>Úložiště {} už není.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The store {} is away: {}.</source>
        <translation>Úložiště {} není dostupné: {}.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The store {} is away: there is no such file; connect its disk, or name another store.</source>
        <translation>Úložiště {} není dostupné: takový soubor není; připojte jeho disk, nebo uveďte jiné úložiště.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The store {} is away: there is no folder {}; connect its disk, or make it.</source>
        <translation>Úložiště {} není dostupné: složka {} není; připojte její disk, nebo ji vytvořte.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The store {} cannot be used: {}.</source>
        <translation>Úložiště {} nelze použít: {}.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The store {} failed: {}</source>
        <translation>Úložiště {} selhalo: {}</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The database {} holds no store yet; mtr-results import makes one.</source>
        <translation>V databázi {} ještě žádné úložiště není; vytvoří je mtr-results import.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The database holds tables of another program; give the store one of its own.</source>
        <translation>V databázi jsou tabulky jiného programu; dejte úložišti vlastní.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The store {} has version {}, and this program version {}; keep a copy, then bring it up to date with mtr-results upgrade.</source>
        <translation>Úložiště {} má verzi {} a tento program verzi {}; uložte si kopii a pak je aktualizujte příkazem mtr-results upgrade.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The store {} has version {}, which is newer than version {} of this program; install the newer program.</source>
        <translation>Úložiště {} má verzi {}, která je novější než verze {} tohoto programu; nainstalujte novější program.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>{} is no address of a store; give the path of a file, or postgresql://USER:PASSWORD@HOST/DATABASE.</source>
        <translation>{} není adresa úložiště; uveďte cestu k souboru, nebo postgresql://USER:PASSWORD@HOST/DATABASE.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>There is no test {} in the store; mtr-results list shows their numbers.</source>
        <translation>Test {} v úložišti není; čísla testů ukáže mtr-results list.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>another program has been writing to it for too long; try again when that has ended</source>
        <translation>příliš dlouho do něj zapisuje jiný program; zkuste to znovu, až skončí</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>its disk is full; make room</source>
        <translation>jeho disk je plný; uvolněte místo</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>its file cannot be opened; look for the folder and its rights</source>
        <translation>jeho soubor nelze otevřít; zkontrolujte složku a její práva</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>its file may not be written; look for its rights</source>
        <translation>do jeho souboru se nesmí zapisovat; zkontrolujte jeho práva</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>its disk is full, or has errors; make room, and look at the disk</source>
        <translation>jeho disk je plný, nebo má chyby; uvolněte místo a zkontrolujte disk</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>no database server answers there; look whether it runs, and at the address</source>
        <translation>databázový server tam neodpovídá; zkontrolujte, zda běží, a adresu</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>the connection to the database server broke</source>
        <translation>spojení s databázovým serverem se přerušilo</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>the file is none of a store</source>
        <translation>soubor nepatří úložišti</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>its file is damaged; take the last copy of it</source>
        <translation>jeho soubor je poškozený; použijte jeho poslední kopii</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>the database server refuses this user or password</source>
        <translation>databázový server tohoto uživatele nebo heslo odmítá</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>there is no such database or user on the server</source>
        <translation>taková databáze nebo uživatel na serveru není</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>There is no test in {}.</source>
        <translation>V {} není žádný test.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>The {} does not take the order to listen only; end other programs that use it, take another adapter, or choose normal mode (--can-normal) for a bench of one node.</source>
        <translation>{} nepřijal příkaz jen naslouchat; ukončete jiné programy, které jej používají, vezměte jiný adaptér, nebo zvolte normální režim (--can-normal) pro stůl s jedním uzlem.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>python-can&apos;s driver {} has no bit rate of {} bit/s; use one of {}.</source>
        <translation>Ovladač {} knihovny python-can nemá přenosovou rychlost {} bit/s; použijte některou z {}.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>python-can&apos;s driver ixxat is for Windows with the vendor&apos;s VCI; on Linux use the kernel&apos;s interface of the adapter (socketcan).</source>
        <translation>Ovladač ixxat knihovny python-can je pro Windows s VCI od výrobce; v Linuxu použijte rozhraní jádra pro tento adaptér (socketcan).</translation>
    </message>
    <message>
        <location filename="../texts/learn.py" line="5"/>
        <source>The CAN database {} has no signal where it was found; the profile gets a database of its own.</source>
        <translation>Databáze CAN {} tam, kde se stav našel, nemá signál; profil dostane vlastní databázi.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>The CAN adapter does not take the order to listen only (L of slcan), and stays closed; use another adapter or firmware, or choose normal mode (--can-normal) for a bench of one node.</source>
        <translation>Adaptér CAN nepřijal příkaz jen naslouchat (L protokolu slcan) a zůstává zavřený; použijte jiný adaptér nebo firmware, nebo zvolte normální režim (--can-normal) pro stůl s jedním uzlem.</translation>
    </message>
    <message>
        <location filename="../sentences.py" line="54"/>
        <source>“{title}”</source>
        <translation>„{title}“</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>Car profile {} has a text of more than {} characters.</source>
        <translation>Profil auta {} obsahuje text delší než {} znaků.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>No test begins, because the robot&apos;s preflight found: {} Mend it, then run `rosrun mtr_commissioning preflight` on the robot again.</source>
        <translation>Zkouška nezačne, protože kontrola robotu zjistila: {} Odstraňte to a pak na robotu znovu spusťte `rosrun mtr_commissioning preflight`.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot&apos;s clock is {} ahead of this laptop&apos;s: distances do not depend on it, dates in the robot&apos;s logs do; set the one that is wrong, or have the laptop take the robot&apos;s (docs/robot-setup.md, Clocks).</source>
        <translation>Hodiny robotu jdou o {} napřed před hodinami tohoto notebooku: vzdálenosti na tom nezávisí, data v protokolech robotu ano; seřiďte ty, které jdou špatně, nebo ať notebook převezme čas robotu (docs/robot-setup.md, Clocks).</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot&apos;s clock is {} behind this laptop&apos;s: distances do not depend on it, dates in the robot&apos;s logs do; set the one that is wrong, or have the laptop take the robot&apos;s (docs/robot-setup.md, Clocks).</source>
        <translation>Hodiny robotu se o {} opožďují za hodinami tohoto notebooku: vzdálenosti na tom nezávisí, data v protokolech robotu ano; seřiďte ty, které jdou špatně, nebo ať notebook převezme čas robotu (docs/robot-setup.md, Clocks).</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>says {} in line {}, which YAML takes for {}; write the number that is meant, or the text in quotes</source>
        <translation>uvádí {} na řádku {}, což YAML čte jako {}; napište číslo, které máte na mysli, nebo text v uvozovkách</translation>
    </message>
    <message>
        <location filename="../texts/pairing.py" line="5"/>
        <source>The list of paired robots {} cannot be read: {}.</source>
        <translation>Seznam spárovaných robotů {} nelze přečíst: {}.</translation>
    </message>
    <message>
        <location filename="../texts/pairing.py" line="5"/>
        <source>Others may write {}; say chmod {} {}.</source>
        <translation>Do {} mohou zapisovat i jiní; spusťte chmod {} {}.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The progress file belongs to another Car: its {} was {} m, now it measures {} m. Continue the test at the Car with which it was begun, or begin a new one.</source>
        <translation>Soubor průběhu patří k jinému autu: {} byla {} m, nyní je {} m. Pokračujte v testu u auta, se kterým začal, nebo začněte nový.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The test was begun with the simulated robot; continue it with that one, or begin a new test.</source>
        <translation>Test začal se simulovaným robotem; pokračujte s ním, nebo začněte nový test.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The test was begun with a real robot, and now it is the simulated one; continue it with a real one, or begin a new test.</source>
        <translation>Test začal se skutečným robotem a nyní je to simulovaný; pokračujte se skutečným, nebo začněte nový test.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The test was begun with the simulated Car; continue it with that one, or begin a new test.</source>
        <translation>Test začal se simulovaným autem; pokračujte s ním, nebo začněte nový test.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The test was begun at a real Car, and now it is the simulated one; continue it at the real one, or begin a new test.</source>
        <translation>Test začal u skutečného auta a nyní je to simulované; pokračujte u skutečného, nebo začněte nový test.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The car profile {} has changed since the test was begun: {}; restore it, or begin a new test.</source>
        <translation>Profil auta {} se od začátku testu změnil: {}; obnovte jej, nebo začněte nový test.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The file {} has changed since the test was begun.</source>
        <translation>Soubor {} se od začátku testu změnil.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The test was begun with the car profile {}, and now it is {}; continue it with that of before, or begin a new test.</source>
        <translation>Test začal s profilem auta {} a nyní je to {}; pokračujte s tím původním, nebo začněte nový test.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The Car coordinate system is another one than that of {} {}, which gets no more attempts.</source>
        <translation>Souřadnicová soustava auta je jiná než ta, ve které byla změřena {} {}; další pokusy nepřibudou.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>The Car&apos;s bus did not say which key moved its locks, and number {} is under test; increase cause_within_s of the car profile if it says so later.</source>
        <translation>Sběrnice auta neřekla, který klíč změnil jeho zámky, a testuje se číslo {}; pokud to říká později, zvyšte cause_within_s v profilu auta.</translation>
    </message>
    <message>
        <location filename="../texts/cars.py" line="5"/>
        <source>The Car&apos;s locks moved on its bus, and {} was silent; increase cause_within_s of the car profile if it counts later.</source>
        <translation>Zámky auta se podle sběrnice změnily a {} mlčel; pokud počítá později, zvyšte cause_within_s v profilu auta.</translation>
    </message>
    <message>
        <location filename="../texts/limits.py" line="5"/>
        <source>It was not reached, and the line does not tell on which side of the limit it lies.</source>
        <translation>Hranice nebyla dosažena a přímka neuvádí, na které straně limitu leží.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>The tests tell different things here, such as a boundary and the place of one event; choose tests that were measured alike.</source>
        <translation>Zkoušky zde udávají různé věci, například hranici a místo jedné události; vyberte zkoušky měřené stejně.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>What was measured last is taken from {}, where it was kept.</source>
        <translation>Co bylo změřeno naposledy, je vzato ze souboru {}, kam bylo uloženo.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>Another part of this test, measured apart from this one, is kept in {}.</source>
        <translation>Jiná část tohoto testu, změřená odděleně od této, je uložena v souboru {}.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>{} is compressed, as no file of a bundle is: it was packed anew; nothing of it was read.</source>
        <translation>{} je komprimován jako žádný soubor balíčku: byl zabalen znovu; nic z něj nebylo přečteno.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>Its files are larger together than it is: it is no bundle; nothing of it was read.</source>
        <translation>Jeho soubory jsou dohromady větší než on sám: není to balíček; nic z něj nebylo přečteno.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>Another application is writing a bundle with the key of this station; write this one when it has ended.</source>
        <translation>Jiná aplikace zapisuje balíček s klíčem této stanice; zapište tento, až skončí.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>A test is being measured: stop it first, then open or begin another one.</source>
        <translation>Probíhá měření testu: nejdříve je zastavte, pak otevřete nebo začněte jiný.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The window did not react for {} s, nor would its Stop have: the robot was stopped.</source>
        <translation>Okno {} s nereagovalo a jeho Stop by nezabral: robot byl zastaven.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The Car&apos;s sides are known to (95 %): {}; distances from them may be wrong by that much. Fill in {} (data sheet or tape measure) in the robot&apos;s car_file, restart the robot with it, and map the Car again.</source>
        <translation>Strany auta jsou známy na (95 %): {}; o tolik mohou být vzdálenosti od nich chybné. Doplňte {} (z technických údajů nebo změřte pásmem) do souboru car_file robotu, spusťte s ním robot znovu a auto znovu zmapujte.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The Car&apos;s {} is known to {} cm only (95 %); the robot may touch it nearer than {} m. Fill in {} (data sheet or tape measure) in the robot&apos;s car_file, restart the robot with it, and map the Car again.</source>
        <translation>Strana auta ({}) je známa jen na {} cm (95 %); blíže než {} m se jí robot může dotknout. Doplňte {} (z technických údajů nebo změřte pásmem) do souboru car_file robotu, spusťte s ním robot znovu a auto znovu zmapujte.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>{} is not used: {}.</source>
        <translation>{} se nepoužije: {}.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>it is a link</source>
        <translation>je to odkaz</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>it belongs to another user</source>
        <translation>patří jinému uživateli</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>other users may write it</source>
        <translation>mohou do něj zapisovat jiní uživatelé</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>It is damaged: {}</source>
        <translation>Je poškozený: {}</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The file name {} is refused. {}.</source>
        <translation>Název souboru {} je odmítnut. {}.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The file name {} under photos is refused. {}.</source>
        <translation>Název souboru {} v položce photos je odmítnut. {}.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The file name {} is refused. It is a link that leads out of {}.</source>
        <translation>Název souboru {} je odmítnut. Je to odkaz, který vede mimo {}.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>It is not a text</source>
        <translation>Není to text</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>It contains a path separator or a colon</source>
        <translation>Obsahuje oddělovač cesty nebo dvojtečku</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>It contains an invisible character</source>
        <translation>Obsahuje neviditelný znak</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>It begins with a dot</source>
        <translation>Začíná tečkou</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>It begins or ends with a space, or ends with a dot</source>
        <translation>Začíná nebo končí mezerou, nebo končí tečkou</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>Windows reserves it for a device</source>
        <translation>Windows ho vyhrazují pro zařízení</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>File name too long: more than {} bytes</source>
        <translation>Název souboru je příliš dlouhý: více než {} bajtů</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The folder {} is refused. It is a link that leads out of {}.</source>
        <translation>Složka {} je odmítnuta. Je to odkaz, který vede mimo {}.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The folder {} is a link that leads elsewhere; remove it.</source>
        <translation>Složka {} je odkaz, který vede jinam; odstraňte ho.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The folder {} is a link that leads elsewhere.</source>
        <translation>Složka {} je odkaz, který vede jinam.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The file {} is a link that leads elsewhere.</source>
        <translation>Soubor {} je odkaz, který vede jinam.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The photo {} cannot be copied to {}: {}.</source>
        <translation>Fotografii {} nelze zkopírovat do {}: {}.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The photo {} is larger than {} MiB.</source>
        <translation>Fotografie {} je větší než {} MiB.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The photo {} was changed: its check sum is not the recorded one.</source>
        <translation>Fotografie {} byla změněna: její kontrolní součet není ten zaznamenaný.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>Car profile {}: CAN databases must be next to the profile or in the folder set by {}. {}</source>
        <translation>Profil auta {}: databáze CAN musí být vedle profilu nebo ve složce, kterou určuje {}. {}</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>Car profile {}: {} holds no CAN messages.</source>
        <translation>Profil auta {}: {} neobsahuje žádné zprávy CAN.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The store&apos;s record of this test is damaged, or written by a newer version; import the test again, or update this program.</source>
        <translation>Záznam tohoto testu v úložišti je poškozený, nebo ho zapsala novější verze; importujte test znovu, nebo aktualizujte tento program.</translation>
    </message>
    <message>
        <location filename="../texts/keeping.py" line="5"/>
        <source>The store names the content {}, which is no SHA-256 check sum.</source>
        <translation>Úložiště uvádí obsah {}, což není kontrolní součet SHA-256.</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>more than one boundary; the interval reaches from the nearest to the farthest</source>
        <translation>více než jedna hranice; interval sahá od nejbližší po nejvzdálenější</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>more than one boundary, a hole from {} to {} m; the interval reaches from the nearest boundary to the farthest</source>
        <translation>více než jedna hranice, mezera od {} do {} m; interval sahá od nejbližší hranice po nejvzdálenější</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>more than one boundary, a hole up to {} m; the interval reaches from the nearest boundary to the farthest</source>
        <translation>více než jedna hranice, mezera až do {} m; interval sahá od nejbližší hranice po nejvzdálenější</translation>
    </message>
    <message>
        <location filename="../texts/judgement.py" line="5"/>
        <source>The last estimate, with all lines, has wider 95 % intervals: {}.</source>
        <translation>Poslední odhad ze všech přímek má širší 95% intervaly: {}.</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="5"/>
        <source>Car profile {}: phone_distance names the signal {}, whose scale in the database is 0.</source>
        <translation>Profil auta {}: phone_distance uvádí signál {}, jehož měřítko je v databázi 0.</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>The CAN log {} is damaged after {} frames; those are used.</source>
        <translation>Záznam CAN {} je po {} rámcích poškozený; použijí se tyto rámce.</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>The CAN log {} is damaged after {} frames ({}); those are used.</source>
        <translation>Záznam CAN {} je po {} rámcích poškozený ({}); použijí se tyto rámce.</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>The CAN log {} is cut off after {} frames; those are used.</source>
        <translation>Záznam CAN {} po {} rámcích předčasně končí; použijí se tyto rámce.</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>it is damaged or of another format</source>
        <translation>je poškozený nebo v jiném formátu</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>it is cut off before its first frame</source>
        <translation>končí před prvním rámcem</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>the next frame {}</source>
        <translation>další rámec {}</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>has the time {} s, which no clock shows</source>
        <translation>má čas {} s, který žádné hodiny neukazují</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>it is a log of the kind {} that was packed with gzip; unpack it first</source>
        <translation>je to záznam formátu {} zabalený programem gzip; nejprve ho rozbalte</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>its packed data is cut off</source>
        <translation>jeho zabalená data předčasně končí</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>its packed data is cut off or corrupt at its beginning</source>
        <translation>jeho zabalená data hned na začátku předčasně končí nebo jsou poškozená</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>its packed data is corrupt there or before</source>
        <translation>jeho zabalená data jsou v tomto místě nebo před ním poškozená</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>its header is cut off</source>
        <translation>jeho hlavička předčasně končí</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>its header states a length of {} bytes, and has {}</source>
        <translation>jeho hlavička udává délku {} bajtů, a má {}</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>no object begins at byte {}</source>
        <translation>na bajtu {} nezačíná žádný objekt</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>the object at byte {} states {} bytes, more than the file has</source>
        <translation>objekt na bajtu {} udává {} bajtů, více než má soubor</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>the object at byte {} is of kind {}, and only containers (10) can be there</source>
        <translation>objekt na bajtu {} je druhu {}, a být tam mohou jen kontejnery (10)</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>an object that begins in the container at byte {} is incomplete</source>
        <translation>objekt, který začíná v kontejneru na bajtu {}, je neúplný</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>in the container at byte {}, {}</source>
        <translation>v kontejneru na bajtu {}: {}</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>an object is shorter than its kind</source>
        <translation>objekt je kratší, než jeho druh vyžaduje</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>no object begins behind the last one</source>
        <translation>za posledním objektem nezačíná žádný další</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>an object states a length of {} bytes</source>
        <translation>objekt udává délku {} bajtů</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>the container at byte {} is shorter than its header</source>
        <translation>kontejner na bajtu {} je kratší než jeho hlavička</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>the container at byte {} has the unknown compression method {}</source>
        <translation>kontejner na bajtu {} má neznámý způsob komprese {}</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>the container at byte {} states {} bytes, {}</source>
        <translation>kontejner na bajtu {} udává {} bajtů, {}</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>the container at byte {} states {} inflated bytes, {}</source>
        <translation>kontejner na bajtu {} udává {} rozbalených bajtů, {}</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>and at most {} MiB are read</source>
        <translation>a čte se nejvýše {} MiB</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>the container at byte {} inflates to more than the {} bytes that it states</source>
        <translation>kontejner na bajtu {} se rozbalí na více než {} bajtů, které udává</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>the compressed data of the container at byte {} is corrupt</source>
        <translation>komprimovaná data kontejneru na bajtu {} jsou poškozená</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>the compressed data of the container at byte {} is incomplete</source>
        <translation>komprimovaná data kontejneru na bajtu {} jsou neúplná</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>the compressed block at byte {} inflates to more than {} MiB</source>
        <translation>komprimovaný blok na bajtu {} se rozbalí na více než {} MiB</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>SQLite reports: {}</source>
        <translation>SQLite hlásí: {}</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>it has no table {}, as python-can writes it</source>
        <translation>nemá tabulku {}, jakou zapisuje python-can</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>its table {} computes values that it does not store</source>
        <translation>jeho tabulka {} počítá hodnoty, které neobsahuje</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>row {} has values of other types than a frame</source>
        <translation>řádek {} má hodnoty jiných typů než rámec</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>row {} has {} bytes of data, and says {}</source>
        <translation>řádek {} má {} bajtů dat, a udává {}</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>row {} {}</source>
        <translation>řádek {} {}</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>asammdf reports damage</source>
        <translation>asammdf hlásí poškození</translation>
    </message>
    <message>
        <location filename="../texts/bus/logs.py" line="5"/>
        <source>asammdf crashes</source>
        <translation>asammdf havaruje</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot&apos;s battery is nearly empty ({} %); charge it, then begin the test.</source>
        <translation>Baterie robota je téměř vybitá ({} %); nabijte ji a pak zahajte test.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>Message {} (id {}) comes only on the bus {}, and the car profile expects it on the bus of the state. Swap the adapters; in a log, number the channels so that the bus of the state is channel 0 and the bus {} is channel {}.</source>
        <translation>Zpráva {} (id {}) přichází jen na sběrnici {}, a profil auta ji čeká na sběrnici stavu. Prohoďte adaptéry; v záznamu očíslujte kanály tak, aby sběrnice stavu byla kanál 0 a sběrnice {} kanál {}.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>Message {} (id {}) comes only on {} of the log, and the car profile expects it on channel 0, because it names further buses (buses). Number the channels of the log so that the bus of the state is channel 0.</source>
        <translation>Zpráva {} (id {}) přichází jen na {} záznamu, a profil auta ji čeká na kanálu 0, protože uvádí další sběrnice (buses). Očíslujte kanály záznamu tak, aby sběrnice stavu byla kanál 0.</translation>
    </message>
    <message>
        <location filename="../texts/bus/can.py" line="5"/>
        <source>several messages refer to the same signals too often</source>
        <translation>několik zpráv odkazuje příliš často na tytéž signály</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot does not report the charge of its battery; check the topic of its battery, then begin the test.</source>
        <translation>Robot nehlásí stav nabití baterie; zkontrolujte téma jeho baterie, pak zahajte test.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot&apos;s battery is critical; charge the robot, then continue.</source>
        <translation>Baterie robotu je kriticky vybitá; nabijte robot, pak pokračujte.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>the battery is critical: lower the key</source>
        <translation>baterie je kriticky vybitá: spouští se klíč</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>return to the start place</source>
        <translation>návrat na výchozí místo</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>the robot stays here: its start place is not known</source>
        <translation>robot zůstává zde: jeho výchozí místo není známo</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>the robot stays here: {}</source>
        <translation>robot zůstává zde: {}</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>Set the test area.</source>
        <translation>Nastavit zkušební prostor.</translation>
    </message>
    <message>
        <location filename="../events/sentences.py" line="5"/>
        <source>Remove the test area.</source>
        <translation>Odstranit zkušební prostor.</translation>
    </message>
    <message>
        <location filename="../texts/safety/area.py" line="5"/>
        <source>A test area has {} corners; the number must be between {} and {}.</source>
        <translation>Zkušební prostor má rohů: {}; musí jich být od {} do {}.</translation>
    </message>
    <message>
        <location filename="../texts/safety/area.py" line="5"/>
        <source>Corners of a test area must be within {} m of where the robot started.</source>
        <translation>Rohy zkušebního prostoru musí být do {} m od místa, kde se robot spustil.</translation>
    </message>
    <message>
        <location filename="../texts/safety/area.py" line="5"/>
        <source>Two neighbouring corners of the test area are at the same place.</source>
        <translation>Dva sousední rohy zkušebního prostoru jsou na stejném místě.</translation>
    </message>
    <message>
        <location filename="../texts/safety/area.py" line="5"/>
        <source>The border of the test area crosses itself.</source>
        <translation>Hranice zkušebního prostoru se kříží.</translation>
    </message>
    <message>
        <location filename="../texts/safety/area.py" line="5"/>
        <source>The test area is {} m2 large; it must be between {} and {} m2.</source>
        <translation>Zkušební prostor má {} m2; musí mít od {} do {} m2.</translation>
    </message>
    <message>
        <location filename="../texts/safety/area.py" line="5"/>
        <source>Corner {} of the test area must be two numbers, x and y in m, such as 4.0 -2.5.</source>
        <translation>Roh {} zkušebního prostoru musí být dvě čísla, x a y v m, například 4.0 -2.5.</translation>
    </message>
    <message>
        <location filename="../texts/safety/area.py" line="5"/>
        <source>The robot does not know its position yet, so it cannot keep a test area.</source>
        <translation>Robot ještě nezná svou polohu, takže zkušební prostor nemůže dodržet.</translation>
    </message>
    <message>
        <location filename="../texts/safety/area.py" line="5"/>
        <source>The robot&apos;s launch file sets its test area; begin the test without another one.</source>
        <translation>Zkušební prostor určuje spouštěcí soubor robotu; začněte test bez dalšího.</translation>
    </message>
    <message>
        <location filename="../texts/safety/area.py" line="5"/>
        <source>The robot&apos;s software is too old to keep a test area; update it, or begin without one.</source>
        <translation>Software robotu je pro zkušební prostor příliš starý; aktualizujte ho, nebo začněte bez prostoru.</translation>
    </message>
    <message>
        <location filename="../texts/safety/area.py" line="5"/>
        <source>The robot did not accept the test area. {}</source>
        <translation>Robot zkušební prostor nepřijal. {}</translation>
    </message>
    <message>
        <location filename="../texts/safety/area.py" line="5"/>
        <source>No test begins. {}</source>
        <translation>Test nezačne. {}</translation>
    </message>
    <message>
        <location filename="../texts/safety/supervision.py" line="5"/>
        <source>The Car&apos;s ignition is on (signal {}).</source>
        <translation>Zapalování auta je zapnuté (signál {}).</translation>
    </message>
    <message>
        <location filename="../texts/safety/supervision.py" line="5"/>
        <source>The Car&apos;s gear is not P (signal {}).</source>
        <translation>Auto nemá zařazeno P (signál {}).</translation>
    </message>
    <message>
        <location filename="../texts/safety/supervision.py" line="5"/>
        <source>The Car moves (signal {}).</source>
        <translation>Auto se pohybuje (signál {}).</translation>
    </message>
    <message>
        <location filename="../texts/safety/supervision.py" line="5"/>
        <source>A door or lid of the Car is open: {} (signal {}).</source>
        <translation>Auto má otevřené dveře nebo víko: {} (signál {}).</translation>
    </message>
    <message>
        <location filename="../texts/safety/supervision.py" line="5"/>
        <source>The robot was stopped. {}</source>
        <translation>Robot byl zastaven. {}</translation>
    </message>
    <message>
        <location filename="../texts/safety/supervision.py" line="5"/>
        <source>The robot was stopped. {} Secure the Car, then continue the test.</source>
        <translation>Robot byl zastaven. {} Zajistěte auto a pak pokračujte ve zkoušce.</translation>
    </message>
    <message>
        <location filename="../texts/safety/supervision.py" line="5"/>
        <source>No output at the Car is switched. {}</source>
        <translation>U auta se nesepne žádný výstup. {}</translation>
    </message>
    <message>
        <location filename="../texts/safety/supervision.py" line="5"/>
        <source>Car profile {}: {} of {} must be a table of message, signal and parked; bus and unknown are optional.</source>
        <translation>Profil auta {}: {} v {} musí být tabulka s message, signal a parked; bus a unknown jsou volitelné.</translation>
    </message>
    <message>
        <location filename="../texts/safety/supervision.py" line="5"/>
        <source>Car profile {}: {} of {} has no parked value: the robot could never move.</source>
        <translation>Profil auta {}: {} v {} nemá žádnou hodnotu parked: robot by se nikdy nemohl pohnout.</translation>
    </message>
    <message>
        <location filename="../texts/safety/supervision.py" line="5"/>
        <source>Car profile {}: {} of {} lists no parked value that the signal {} can carry.</source>
        <translation>Profil auta {}: {} v {} neuvádí v parked žádnou hodnotu, kterou signál {} může přenést.</translation>
    </message>
    <message>
        <location filename="../texts/safety/supervision.py" line="5"/>
        <source>Car profile {}: {} of {} lists {} as parked and as unknown.</source>
        <translation>Profil auta {}: {} v {} uvádí {} jako parked i jako unknown.</translation>
    </message>
    <message>
        <location filename="../texts/safety/supervision.py" line="5"/>
        <source>Car profile {}: {} of {} has {}: {}; allowed is a list of whole numbers.</source>
        <translation>Profil auta {}: {} v {} má {}: {}; přípustný je seznam celých čísel.</translation>
    </message>
    <message>
        <location filename="../texts/safety/supervision.py" line="5"/>
        <source>Nobody confirmed within {} s to be present: the robot was stopped. The test is kept; resume it in sight of the robot.</source>
        <translation>Nikdo do {} s nepotvrdil přítomnost: robot byl zastaven. Zkouška je uložena; pokračujte v ní s robotem na dohled.</translation>
    </message>
    <message>
        <location filename="../texts/safety/supervision.py" line="5"/>
        <source>Presence confirmed.</source>
        <translation>Přítomnost potvrzena.</translation>
    </message>
    <message>
        <location filename="../texts/safety/supervision.py" line="5"/>
        <source>No test begins on a real robot without a person: nobody can be asked here, and the configuration declares no unattended_stop (laboratory.yaml), the name of a rated stop.</source>
        <translation>Na skutečném robotu nezačne zkouška bez osoby: zde se není koho ptát a nastavení neuvádí unattended_stop (laboratory.yaml), název certifikovaného zastavení.</translation>
    </message>
    <message>
        <location filename="../texts/safety/supervision.py" line="5"/>
        <source>No test begins on a real robot without a person in charge: name one under Car, key and operator, or as person_in_charge of the identity file.</source>
        <translation>Na skutečném robotu nezačne zkouška bez odpovědné osoby: uveďte ji v části Auto, klíč a operátor nebo jako person_in_charge v souboru identity.</translation>
    </message>
    <message>
        <location filename="../texts/safety/supervision.py" line="5"/>
        <source>No test begins on a real robot before its operating conditions are confirmed: {}.</source>
        <translation>Na skutečném robotu nezačne zkouška, dokud nejsou potvrzeny provozní podmínky: {}.</translation>
    </message>
    <message>
        <location filename="../texts/safety/supervision.py" line="5"/>
        <source>No test begins on a real robot that does not report its preflight; update its software, then run `rosrun mtr_commissioning preflight --drive` on it.</source>
        <translation>Na skutečném robotu, který nehlásí svou kontrolu, nezačne zkouška; aktualizujte jeho program a pak na něm spusťte `rosrun mtr_commissioning preflight --drive`.</translation>
    </message>
    <message>
        <location filename="../texts/safety/supervision.py" line="5"/>
        <source>No test begins on a real robot before a preflight in motion, since its start or its last update: run `rosrun mtr_commissioning preflight --drive` on it.</source>
        <translation>Na skutečném robotu nezačne zkouška bez kontroly za jízdy od jeho spuštění nebo poslední aktualizace: spusťte na něm `rosrun mtr_commissioning preflight --drive`.</translation>
    </message>
    <message>
        <location filename="../texts/safety/supervision.py" line="5"/>
        <source>No test begins on a real robot before a preflight in motion; the last one was made at rest: run `rosrun mtr_commissioning preflight --drive` on it.</source>
        <translation>Na skutečném robotu nezačne zkouška bez kontroly za jízdy; poslední byla provedena vstoje: spusťte na něm `rosrun mtr_commissioning preflight --drive`.</translation>
    </message>
    <message>
        <location filename="../texts/safety/supervision.py" line="5"/>
        <source>No test begins on a real robot whose preflight in motion was made {} ago; allowed are {}: run `rosrun mtr_commissioning preflight --drive` on it.</source>
        <translation>Na skutečném robotu nezačne zkouška, když je kontrola za jízdy stará {}; přípustné je {}: spusťte na něm `rosrun mtr_commissioning preflight --drive`.</translation>
    </message>
    <message>
        <location filename="../texts/safety/supervision.py" line="5"/>
        <source>A press may sound the horn or the alarm, or open the tailgate. Announce the test; people next to the Car wear ear protection.</source>
        <translation>Stisk může spustit klakson nebo alarm nebo otevřít páté dveře. Zkoušku ohlaste; lidé u auta nosí chrániče sluchu.</translation>
    </message>
    <message>
        <location filename="../texts/safety/supervision.py" line="5"/>
        <source>A pull at the handle of a locked Car may set off its alarm. Announce the test; people next to the Car wear ear protection.</source>
        <translation>Zatažení za kliku zamčeného auta může spustit alarm. Zkoušku ohlaste; lidé u auta nosí chrániče sluchu.</translation>
    </message>
    <message>
        <location filename="../texts/safety/supervision.py" line="5"/>
        <source>The Car may sound its horn when it locks or unlocks. Announce the test; people next to the Car wear ear protection.</source>
        <translation>Auto může při zamčení nebo odemčení zatroubit. Zkoušku ohlaste; lidé u auta nosí chrániče sluchu.</translation>
    </message>
    <message>
        <location filename="../texts/application.py" line="11"/>
        <source>The robot has no hand-held emergency stop, so no test begins. Start it with its controller (controller:=true).</source>
        <translation>Robot nemá ruční nouzové zastavení, proto žádná zkouška nezačne. Spusťte jej s ovladačem (controller:=true).</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>Side {}: {}</source>
        <translation>Strana {}: {}</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>The line is invalid.</source>
        <translation>Přímka je neplatná.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>The key worked on no line of this test; it may have been asleep.</source>
        <translation>Klíč nefungoval na žádné přímce tohoto testu; možná spal.</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>front side</source>
        <translation>přední strana</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>right side</source>
        <translation>pravá strana</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>rear side</source>
        <translation>zadní strana</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>left side</source>
        <translation>levá strana</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>all lines</source>
        <translation>všechny přímky</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>area</source>
        <translation>plocha</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>area at {} m</source>
        <translation>plocha ve výšce {} m</translation>
    </message>
    <message>
        <location filename="../texts/identity.py" line="20"/>
        <source>A side of the comparison has no test.</source>
        <translation>Jedna strana porovnání nemá žádný test.</translation>
    </message>
    <message>
        <location filename="../texts/safety/service.py" line="5"/>
        <source>The robot&apos;s software is too old for service mode; update it, or switch the robot off for work on it.</source>
        <translation>Software robotu je na servisní režim příliš starý; aktualizujte ho, nebo robot při práci na něm vypněte.</translation>
    </message>
    <message>
        <location filename="../texts/safety/service.py" line="5"/>
        <source>The robot did not enter service mode; switch it off before you work on it.</source>
        <translation>Robot nepřešel do servisního režimu; před prací na něm ho vypněte.</translation>
    </message>
    <message>
        <location filename="../texts/safety/service.py" line="5"/>
        <source>Another application controls the robot: release service mode there.</source>
        <translation>Robot řídí jiná aplikace: uvolněte servisní režim v ní.</translation>
    </message>
    <message>
        <location filename="../texts/safety/service.py" line="5"/>
        <source>The robot was not released on its own side in time; service mode remains active.</source>
        <translation>Robot nebyl včas uvolněn na své straně; servisní režim trvá.</translation>
    </message>
    <message>
        <location filename="../texts/safety/service.py" line="5"/>
        <source>The robot has not answered for {} s.</source>
        <translation>Robot neodpovídá už {} s.</translation>
    </message>
    <message>
        <location filename="../texts/safety/service.py" line="5"/>
        <source>Enter service mode.</source>
        <translation>Zapnout servisní režim.</translation>
    </message>
    <message>
        <location filename="../texts/safety/service.py" line="5"/>
        <source>Release service mode.</source>
        <translation>Uvolnit servisní režim.</translation>
    </message>
</context>
<context>
    <name>ServiceCard</name>
    <message>
        <location filename="../windows/service_card.py" line="24"/>
        <source>Service mode</source>
        <translation>Servisní režim</translation>
    </message>
    <message>
        <location filename="../windows/service_card.py" line="80"/>
        <source>Enter service mode</source>
        <translation>Zapnout servisní režim</translation>
    </message>
    <message>
        <location filename="../windows/service_card.py" line="31"/>
        <source>Hold to release service mode</source>
        <translation>Podržením uvolnit servisní režim</translation>
    </message>
    <message>
        <location filename="../windows/service_card.py" line="33"/>
        <source>For work on mast, lift, servos or wheels. It remains active after restarts. It ends when it is released here and on the robot (rosrun mtr_dispatcher service_mode release) within a minute. It does not isolate energy: switch the robot off where you can.</source>
        <translation>Pro práci na stožáru, zdvihu, servech nebo kolech. Trvá i po novém startu. Skončí, když se do minuty uvolní zde i na robotu (rosrun mtr_dispatcher service_mode release). Neodpojuje energii: kde to jde, robot vypněte.</translation>
    </message>
    <message>
        <location filename="../windows/service_card.py" line="63"/>
        <source>The robot is silent, or its software is too old for service mode.</source>
        <translation>Robot mlčí, nebo je jeho software na servisní režim příliš starý.</translation>
    </message>
    <message>
        <location filename="../windows/service_card.py" line="65"/>
        <source>Not active.</source>
        <translation>Není zapnutý.</translation>
    </message>
    <message>
        <location filename="../windows/service_card.py" line="68"/>
        <source>Released on the robot: hold the button within {time} s.</source>
        <translation>Uvolněno na robotu: do {time} s podržte tlačítko.</translation>
    </message>
    <message>
        <location filename="../windows/service_card.py" line="70"/>
        <source>Released here: release it on the robot within {time} s.</source>
        <translation>Uvolněno zde: do {time} s ho uvolněte na robotu.</translation>
    </message>
    <message>
        <location filename="../windows/service_card.py" line="76"/>
        <source>The robot stops, and its wheels, lift and servos are disabled, also after a restart, until both sides release them. A test is paused. Enter service mode?</source>
        <translation>Robot se zastaví a jeho kola, zdvih a serva budou vypnuté, i po novém startu, dokud je obě strany neuvolní. Test se přeruší. Zapnout servisní režim?</translation>
    </message>
    <message>
        <location filename="../windows/service_card.py" line="80"/>
        <source>Cancel</source>
        <translation>Zrušit</translation>
    </message>
</context>
<context>
    <name>SettingsScreen</name>
    <message>
        <location filename="../screens/settings.py" line="102"/>
        <source>Back</source>
        <translation>Zpět</translation>
    </message>
    <message>
        <location filename="../screens/settings.py" line="213"/>
        <source>{count} lines ({word}), about {time}.</source>
        <translation>Počet přímek ({word}): {count}, asi {time}.</translation>
    </message>
    <message>
        <location filename="../screens/settings.py" line="217"/>
        <source>The Car is not measured yet; its size is a guess.</source>
        <translation>Auto ještě není změřeno; jeho rozměry jsou odhad.</translation>
    </message>
    <message>
        <location filename="../screens/settings.py" line="222"/>
        <source>The battery, at {percent} %, suffices.</source>
        <translation>Baterie ({percent} %) stačí.</translation>
    </message>
    <message>
        <location filename="../screens/settings.py" line="223"/>
        <source>The battery, at {percent} %, may not suffice: the test takes about {need} %.</source>
        <translation>Baterie ({percent} %) nemusí stačit: test spotřebuje asi {need} %.</translation>
    </message>
    <message>
        <location filename="../screens/settings.py" line="81"/>
        <source>Hold to start</source>
        <translation>Podržením spustit</translation>
    </message>
    <message>
        <location filename="../screens/settings.py" line="180"/>
        <source>Something stands in the way of {lines}: grey squares, the nearest {distance} m from the Car. Move it, or measure from nearer.</source>
        <translation>V cestě stojí překážka ({lines}): šedé čtverce, nejbližší {distance} m od auta. Odstraňte ji, nebo měřte z menší vzdálenosti.</translation>
    </message>
    <message>
        <location filename="../screens/settings.py" line="212"/>
        <source>No preview of the lines while the parameters are not right.</source>
        <translation>Dokud nejsou parametry v pořádku, není náhled přímek.</translation>
    </message>
    <message>
        <location filename="../screens/settings.py" line="188"/>
        <source>Not all seen by the robot yet: {lines}.</source>
        <translation>Robot ještě celé neviděl: {lines}.</translation>
    </message>
    <message>
        <location filename="../screens/settings.py" line="253"/>
        <source>Name the person in charge under Car, key and operator.</source>
        <translation>Uveďte odpovědnou osobu v části Auto, klíč a operátor.</translation>
    </message>
    <message>
        <location filename="../screens/settings.py" line="254"/>
        <source>Confirm each operating condition below the parameters.</source>
        <translation>Potvrďte pod parametry každou provozní podmínku.</translation>
    </message>
</context>
<context>
    <name>SettingsWindow</name>
    <message>
        <location filename="../windows/settings_window.py" line="40"/>
        <source>Settings</source>
        <translation>Nastavení</translation>
    </message>
    <message>
        <location filename="../windows/settings_window.py" line="43"/>
        <source>Results</source>
        <translation>Výsledky</translation>
    </message>
    <message>
        <location filename="../windows/settings_window.py" line="44"/>
        <source>Progress of tests</source>
        <translation>Průběh testů</translation>
    </message>
    <message>
        <location filename="../windows/settings_window.py" line="45"/>
        <source>IP address</source>
        <translation>IP adresa</translation>
    </message>
    <message>
        <location filename="../windows/settings_window.py" line="46"/>
        <source>Subscriber port</source>
        <translation>Port odběratele</translation>
    </message>
    <message>
        <location filename="../windows/settings_window.py" line="47"/>
        <source>Publisher port</source>
        <translation>Port vydavatele</translation>
    </message>
    <message>
        <location filename="../windows/settings_window.py" line="54"/>
        <source>Use this adapter</source>
        <translation>Použít tento adaptér</translation>
    </message>
    <message>
        <location filename="../windows/settings_window.py" line="167"/>
        <source>The CAN adapter is in use.</source>
        <translation>Adaptér CAN se používá.</translation>
    </message>
    <message>
        <location filename="../windows/settings_window.py" line="101"/>
        <source>Folders</source>
        <translation>Složky</translation>
    </message>
    <message>
        <location filename="../windows/settings_window.py" line="109"/>
        <source>Robot</source>
        <translation>Robot</translation>
    </message>
    <message>
        <location filename="../windows/settings_window.py" line="104"/>
        <source>Appearance</source>
        <translation>Vzhled</translation>
    </message>
    <message>
        <location filename="../windows/settings_window.py" line="116"/>
        <source>Car</source>
        <translation>Auto</translation>
    </message>
    <message>
        <location filename="../windows/settings_window.py" line="79"/>
        <source>Close</source>
        <translation>Zavřít</translation>
    </message>
    <message>
        <location filename="../windows/settings_window.py" line="123"/>
        <source>Change</source>
        <translation>Změnit</translation>
    </message>
    <message>
        <location filename="../windows/settings_window.py" line="124"/>
        <source>Change the folder: {what}</source>
        <translation>Změnit složku: {what}</translation>
    </message>
    <message>
        <location filename="../windows/settings_window.py" line="137"/>
        <source>Folder for results</source>
        <translation>Složka pro výsledky</translation>
    </message>
    <message>
        <location filename="../windows/settings_window.py" line="144"/>
        <source>Folder for the progress of tests</source>
        <translation>Složka pro průběh testů</translation>
    </message>
    <message>
        <location filename="../windows/settings_window.py" line="184"/>
        <source>The CAN adapter that you have chosen is not in use yet. Use it?</source>
        <translation>Zvolený adaptér CAN se zatím nepoužívá. Použít jej?</translation>
    </message>
    <message>
        <location filename="../windows/settings_window.py" line="187"/>
        <source>Use it</source>
        <translation>Použít</translation>
    </message>
    <message>
        <location filename="../windows/settings_window.py" line="187"/>
        <source>Leave it as it was</source>
        <translation>Ponechat původní</translation>
    </message>
</context>
<context>
    <name>Spread</name>
    <message>
        <location filename="../history/spread_model.py" line="53"/>
        <source>{count} of {all}</source>
        <translation>{count} z {all}</translation>
    </message>
    <message>
        <location filename="../history/spread_picture.py" line="36"/>
        <source>Each test</source>
        <translation>Jednotlivé testy</translation>
    </message>
    <message>
        <location filename="../history/spread_picture.py" line="45"/>
        <source>Mean</source>
        <translation>Průměr</translation>
    </message>
</context>
<context>
    <name>SpreadModel</name>
    <message>
        <location filename="../history/spread_model.py" line="45"/>
        <source>Tests</source>
        <translation>Testy</translation>
    </message>
    <message>
        <location filename="../history/spread_model.py" line="45"/>
        <source>Mean [m]</source>
        <translation>Průměr [m]</translation>
    </message>
    <message>
        <location filename="../history/spread_model.py" line="45"/>
        <source>95 % of the mean [m]</source>
        <translation>95 % průměru [m]</translation>
    </message>
    <message>
        <location filename="../history/spread_model.py" line="45"/>
        <source>Std. deviation [m]</source>
        <translation>Směr. odchylka [m]</translation>
    </message>
    <message>
        <location filename="../history/spread_model.py" line="45"/>
        <source>95 % of it [m]</source>
        <translation>její 95 % [m]</translation>
    </message>
    <message>
        <location filename="../history/spread_model.py" line="45"/>
        <source>Smallest to largest [m]</source>
        <translation>Nejmenší až největší [m]</translation>
    </message>
</context>
<context>
    <name>SpreadWindow</name>
    <message>
        <location filename="../history/spread_window.py" line="30"/>
        <source>Spread of repeated tests</source>
        <translation>Rozptyl opakovaných testů</translation>
    </message>
    <message>
        <location filename="../history/spread_window.py" line="32"/>
        <source>Mean and standard deviation of each distance</source>
        <translation>Průměr a směrodatná odchylka každé vzdálenosti</translation>
    </message>
    <message>
        <location filename="../history/spread_window.py" line="47"/>
        <source>{scenario}, {count} tests from {first} to {last}</source>
        <translation>{scenario}, testů: {count}, od {first} do {last}</translation>
    </message>
    <message>
        <location filename="../history/spread_window.py" line="51"/>
        <source>The tests differ in: {names}. What that does to the distances is in the spread.</source>
        <translation>Testy se liší v: {names}. Co to dělá se vzdálenostmi, je v rozptylu.</translation>
    </message>
    <message>
        <location filename="../history/spread_window.py" line="55"/>
        <source>Lines that the first test has not: {count}. They are left out.</source>
        <translation>Přímky, které první test nemá: {count}. Jsou vynechány.</translation>
    </message>
    <message>
        <location filename="../history/spread_window.py" line="56"/>
        <source>The mean&apos;s interval is that of the tests&apos; spread, wider by what no repetition shows: the Car&apos;s outline, mast, floor and lever of the key.</source>
        <translation>Interval průměru je dán rozptylem testů a rozšířen o to, co opakování neukáže: obrys auta, stožár, podlahu a rameno klíče.</translation>
    </message>
    <message>
        <location filename="../history/spread_window.py" line="58"/>
        <source>The standard deviation is that of one test of the same car and key; it has an interval from three tests on. Tests that know only an end have no value and are not in it.</source>
        <translation>Směrodatná odchylka je odchylka jednoho testu stejného auta a klíče; interval má od tří testů. Testy, které znají jen jednu mez, nemají hodnotu a nejsou v ní.</translation>
    </message>
</context>
<context>
    <name>Status</name>
    <message>
        <location filename="../header/reasons.py" line="14"/>
        <source>Ready</source>
        <translation>Připraveno</translation>
    </message>
    <message>
        <location filename="../header/reasons.py" line="15"/>
        <source>Ready with warnings</source>
        <translation>S výhradami</translation>
    </message>
    <message>
        <location filename="../header/reasons.py" line="16"/>
        <source>Not ready</source>
        <translation>Nepřipraveno</translation>
    </message>
    <message>
        <location filename="../header/reasons.py" line="17"/>
        <source>Measuring</source>
        <translation>Měří se</translation>
    </message>
    <message>
        <location filename="../header/reasons.py" line="18"/>
        <source>Paused</source>
        <translation>Pozastaveno</translation>
    </message>
    <message>
        <location filename="../header/reasons.py" line="19"/>
        <source>Communication lost</source>
        <translation>Spojení ztraceno</translation>
    </message>
    <message>
        <location filename="../header/reasons.py" line="31"/>
        <source>The robot has not answered for {detail} s.</source>
        <translation>Robot neodpovídá {detail} s.</translation>
    </message>
    <message>
        <location filename="../header/reasons.py" line="32"/>
        <source>The robot is still starting.</source>
        <translation>Robot se ještě spouští.</translation>
    </message>
    <message>
        <location filename="../header/reasons.py" line="33"/>
        <source>The robot reports a fault.</source>
        <translation>Robot hlásí poruchu.</translation>
    </message>
    <message>
        <location filename="../header/reasons.py" line="34"/>
        <source>Another application controls the robot.</source>
        <translation>Robot ovládá jiná aplikace.</translation>
    </message>
    <message>
        <location filename="../header/reasons.py" line="36"/>
        <source>The robot&apos;s battery is nearly empty: {detail} %.</source>
        <translation>Baterie robotu je téměř vybitá: {detail} %.</translation>
    </message>
    <message>
        <location filename="../header/reasons.py" line="37"/>
        <source>The robot&apos;s battery is low: {detail} %.</source>
        <translation>Baterie robotu je slabá: {detail} %.</translation>
    </message>
    <message>
        <location filename="../header/reasons.py" line="39"/>
        <source>No CAN adapter is chosen.</source>
        <translation>Není vybrán adaptér CAN.</translation>
    </message>
    <message>
        <location filename="../header/reasons.py" line="41"/>
        <source>The Car does not say whether it is locked.</source>
        <translation>Auto nesděluje, zda je zamčené.</translation>
    </message>
    <message>
        <location filename="../header/reasons.py" line="46"/>
        <source>The robot does not know its position.</source>
        <translation>Robot nezná svou polohu.</translation>
    </message>
    <message>
        <location filename="../header/reasons.py" line="20"/>
        <source>Driving</source>
        <translation>Jede</translation>
    </message>
    <message>
        <location filename="../header/reasons.py" line="21"/>
        <source>Mapping</source>
        <translation>Mapuje</translation>
    </message>
    <message>
        <location filename="../header/reasons.py" line="22"/>
        <source>Checking</source>
        <translation>Ověřuje</translation>
    </message>
    <message>
        <location filename="../header/reasons.py" line="23"/>
        <source>Blocked</source>
        <translation>Zablokován</translation>
    </message>
    <message>
        <location filename="../header/reasons.py" line="42"/>
        <source>The robot stands until you have it go on.</source>
        <translation>Robot stojí, dokud mu nedáte pokyn pokračovat.</translation>
    </message>
    <message>
        <location filename="../header/reasons.py" line="43"/>
        <source>Something blocks the robot&apos;s way.</source>
        <translation>Robotu něco stojí v cestě.</translation>
    </message>
    <message>
        <location filename="../header/reasons.py" line="60"/>
        <source>Look at the cause; then have the robot go on.</source>
        <translation>Prohlédněte příčinu a pak dejte robotu pokyn pokračovat.</translation>
    </message>
    <message>
        <location filename="../header/reasons.py" line="61"/>
        <source>Clear its way; it goes on by itself, or stands until you have it go on.</source>
        <translation>Uvolněte mu cestu; pokračuje sám, nebo stojí, dokud mu nedáte pokyn.</translation>
    </message>
    <message>
        <location filename="../alerts/sounds.py" line="64"/>
        <source>The test is done.</source>
        <translation>Test je hotov.</translation>
    </message>
    <message>
        <location filename="../alerts/sounds.py" line="66"/>
        <source>The robot moves.</source>
        <translation>Robot se pohybuje.</translation>
    </message>
    <message>
        <location filename="../header/reasons.py" line="44"/>
        <source>The robot&apos;s preflight found: {detail}</source>
        <translation>Kontrola robotu zjistila: {detail}</translation>
    </message>
    <message>
        <location filename="../header/reasons.py" line="38"/>
        <source>The robot does not report its charge.</source>
        <translation>Robot nehlásí stav nabití.</translation>
    </message>
    <message>
        <location filename="../alerts/sounds.py" line="68"/>
        <source>Confirm that you are present.</source>
        <translation>Potvrďte svou přítomnost.</translation>
    </message>
</context>
<context>
    <name>StatusWord</name>
    <message>
        <location filename="../header/status_word.py" line="69"/>
        <source>Status: {word}</source>
        <translation>Stav: {word}</translation>
    </message>
    <message>
        <location filename="../header/status_word.py" line="71"/>
        <source>Everything is ready for a test.</source>
        <translation>Vše je připraveno k testu.</translation>
    </message>
    <message>
        <location filename="../header/status_word.py" line="50"/>
        <source>All events</source>
        <translation>Všechny události</translation>
    </message>
</context>
<context>
    <name>StepBar</name>
    <message>
        <location filename="../header/step_bar.py" line="112"/>
        <source>Step {number} of {count}: {title}</source>
        <translation>Krok {number} z {count}: {title}</translation>
    </message>
</context>
<context>
    <name>StopButton</name>
    <message>
        <location filename="../header/stop_button.py" line="23"/>
        <source>Stop</source>
        <translation>Zastavit</translation>
    </message>
    <message>
        <location filename="../header/stop_button.py" line="27"/>
        <source>Stops the robot. While it may move, Space and Esc do so from everywhere.</source>
        <translation>Zastaví robot. Dokud se může pohybovat, zastaví ho odkudkoli i mezerník a Esc.</translation>
    </message>
</context>
<context>
    <name>TestsWindow</name>
    <message>
        <location filename="../history/tests_window.py" line="45"/>
        <source>Distance</source>
        <translation>Vzdálenost</translation>
    </message>
    <message>
        <location filename="../history/tests_window.py" line="75"/>
        <source>Close</source>
        <translation>Zavřít</translation>
    </message>
</context>
<context>
    <name>TimeLineView</name>
    <message>
        <location filename="../bus/time_line_view.py" line="70"/>
        <source>The Car&apos;s locks and the key&apos;s distance over the last minute</source>
        <translation>Zámky auta a vzdálenost klíče za poslední minutu</translation>
    </message>
</context>
<context>
    <name>WarningSymbol</name>
    <message>
        <location filename="../header/warning_symbol.py" line="56"/>
        <source>Notifications of the robot</source>
        <translation>Upozornění robotu</translation>
    </message>
    <message>
        <location filename="../header/warning_symbol.py" line="120"/>
        <source>The robot says</source>
        <translation>Robot sděluje</translation>
    </message>
    <message>
        <location filename="../header/warning_symbol.py" line="121"/>
        <source>The robot said {age} s ago</source>
        <translation>Robot řekl před {age} s</translation>
    </message>
</context>
<context>
    <name>WelcomeScreen</name>
    <message>
        <location filename="../screens/welcome.py" line="31"/>
        <source>What would you like to do?</source>
        <translation>Co chcete udělat?</translation>
    </message>
    <message>
        <location filename="../screens/welcome.py" line="33"/>
        <source>New test</source>
        <translation>Nový test</translation>
    </message>
    <message>
        <location filename="../screens/welcome.py" line="33"/>
        <source>Choose scenario and parameters, and let the robot measure.</source>
        <translation>Vyberte scénář a parametry a nechte robot měřit.</translation>
    </message>
    <message>
        <location filename="../screens/welcome.py" line="37"/>
        <source>Calibrate</source>
        <translation>Kalibrovat</translation>
    </message>
    <message>
        <location filename="../screens/welcome.py" line="37"/>
        <source>Try lift and buttons of the robot.</source>
        <translation>Vyzkoušejte zdvih a tlačítka robotu.</translation>
    </message>
    <message>
        <location filename="../screens/welcome.py" line="63"/>
        <source>The {scenario} test of {moment} is not finished: {done} of {total} lines are measured.</source>
        <translation>Test {scenario} z {moment} není dokončen: změřeno {done} z {total} přímek.</translation>
    </message>
    <message>
        <location filename="../screens/welcome.py" line="78"/>
        <source>Go on with it</source>
        <translation>Pokračovat v něm</translation>
    </message>
    <message>
        <location filename="../screens/welcome.py" line="81"/>
        <source>Not now</source>
        <translation>Teď ne</translation>
    </message>
    <message>
        <location filename="../screens/welcome.py" line="34"/>
        <source>Tests so far</source>
        <translation>Dosavadní testy</translation>
    </message>
    <message>
        <location filename="../screens/welcome.py" line="34"/>
        <source>Open, continue, repeat or compare tests of before.</source>
        <translation>Otevřít, dokončit, opakovat nebo porovnat dřívější testy.</translation>
    </message>
    <message>
        <location filename="../screens/welcome.py" line="35"/>
        <source>Test area</source>
        <translation>Zkušební prostor</translation>
    </message>
    <message>
        <location filename="../screens/welcome.py" line="35"/>
        <source>Draw the area that the robot does not leave; a real robot needs it before it maps the Car.</source>
        <translation>Nakreslete prostor, který robot neopustí; skutečný robot ho potřebuje, než zmapuje auto.</translation>
    </message>
</context>
<context>
    <name>Word</name>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>axis</source>
        <translation>osa</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>radial</source>
        <translation>paprsek</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>unlock</source>
        <translation>odemčení</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>lock</source>
        <translation>zamčení</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>press</source>
        <translation>stisk</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>front</source>
        <translation>vpředu</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>rear</source>
        <translation>vzadu</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>left</source>
        <translation>vlevo</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>right</source>
        <translation>vpravo</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>front left</source>
        <translation>vpředu vlevo</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>front right</source>
        <translation>vpředu vpravo</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>rear left</source>
        <translation>vzadu vlevo</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>rear right</source>
        <translation>vzadu vpravo</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>ok</source>
        <translation>změřeno</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>not reached</source>
        <translation>nedosaženo</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>invalid</source>
        <translation>neplatné</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>locked</source>
        <translation>zamčeno</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>unlocked</source>
        <translation>odemčeno</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>Unlocked</source>
        <translation>Odemčeno</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>Locked</source>
        <translation>Zamčeno</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>Unlock not reached</source>
        <translation>Odemčení nedosaženo</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>Lock not reached</source>
        <translation>Zamčení nedosaženo</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>Invalid</source>
        <translation>Neplatné</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>Press worked</source>
        <translation>Stisk zabral</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>Press failed</source>
        <translation>Stisk nezabral</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>lines</source>
        <translation>přímky</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>nothing measured</source>
        <translation>nic nezměřeno</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>Car measured</source>
        <translation>změřené auto</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>car profile</source>
        <translation>profil auta</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>robot</source>
        <translation>robot</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>software</source>
        <translation>software</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>robot software</source>
        <translation>software robotu</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>length</source>
        <translation>délka</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>width</source>
        <translation>šířka</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>subscriber port</source>
        <translation>port odběratele</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>publisher port</source>
        <translation>port vydavatele</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>subscriber</source>
        <translation>odběratel</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>publisher</source>
        <translation>vydavatel</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>largest uncertainty (95 %)</source>
        <translation>největší nejistota (95 %)</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>verdict</source>
        <translation>verdikt</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>judged lines</source>
        <translation>posouzené přímky</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>pass</source>
        <translation>vyhověl</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>inconclusive</source>
        <translation>nerozhodnuto</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>fail</source>
        <translation>nevyhověl</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>aborted</source>
        <translation>přerušeno</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>50 % of the presses work</source>
        <translation>funguje 50 % stisků</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>95 % of the presses work</source>
        <translation>funguje 95 % stisků</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>Border farther than here</source>
        <translation>hranice dále než zde</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>Border nearer than here</source>
        <translation>hranice blíže než zde</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>Hole</source>
        <translation>díra</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>zone</source>
        <translation>zóna</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>reach</source>
        <translation>dosah</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>Covered for sure</source>
        <translation>Jistě pokryto</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>Covered perhaps</source>
        <translation>Snad pokryto</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>Half of the presses work</source>
        <translation>Funguje polovina stisků</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>handle</source>
        <translation>klika</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>Border: half of the requests inside</source>
        <translation>hranice: polovina žádostí uvnitř</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>Inside</source>
        <translation>uvnitř</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>Outside</source>
        <translation>venku</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>not set</source>
        <translation>neposouzeno</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>place and instant of the key</source>
        <translation>místo a okamžik klíče</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>attempts</source>
        <translation>pokusy</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>length of the Car</source>
        <translation>délka auta</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>width of the Car</source>
        <translation>šířka auta</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>mast_lean_deg</source>
        <translation>náklon stožáru</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>floor_slope_deg</source>
        <translation>sklon podlahy</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>key_lever_m</source>
        <translation>poloha klíče na robotu</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>lidar_yaw_deg</source>
        <translation>natočení lidaru</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>robot&apos;s Status and the Car&apos;s bus</source>
        <translation>stav robotu a sběrnice auta</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>robot&apos;s map of the Car</source>
        <translation>mapa auta v robotu</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>attempts of the test</source>
        <translation>pokusy testu</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>all sides</source>
        <translation>všechny strany</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>started</source>
        <translation>začátek</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>continued</source>
        <translation>pokračování</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>car profile files</source>
        <translation>soubory profilu auta</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>measured again</source>
        <translation>změřeno znovu</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>ended before its end</source>
        <translation>skončil předčasně</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>recovered</source>
        <translation>obnoveno</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>messages of the robot that were not used</source>
        <translation>nepoužité zprávy robotu</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>messages that the robot refused</source>
        <translation>zprávy, které robot odmítl</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>frames of the Car that were not believed</source>
        <translation>rámce auta, kterým se nevěří</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>measured by</source>
        <translation>měřil</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>checked by</source>
        <translation>zkontroloval</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>date</source>
        <translation>datum</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>signature</source>
        <translation>podpis</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>Border unknown</source>
        <translation>Hranice neznámá</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>notes and photos added</source>
        <translation>poznámky a fotografie doplněny</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="60"/>
        <source>position</source>
        <translation>poloha</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="60"/>
        <source>phone</source>
        <translation>telefon</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="60"/>
        <source>Error</source>
        <translation>Chyba</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="60"/>
        <source>No answer</source>
        <translation>Bez odpovědi</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="60"/>
        <source>bias</source>
        <translation>systematická chyba</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="60"/>
        <source>spread of errors</source>
        <translation>rozptyl chyb</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="60"/>
        <source>95 % of errors within</source>
        <translation>95 % chyb do</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="60"/>
        <source>places without answer</source>
        <translation>místa bez odpovědi</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="60"/>
        <source>phone&apos;s distance from</source>
        <translation>vzdálenost telefonu z</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="60"/>
        <source>distances of the phone that were not used</source>
        <translation>vzdálenosti telefonu, které nebyly použity</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="60"/>
        <source>port</source>
        <translation>port</translation>
    </message>
    <message>
        <location filename="../texts/keys/phone.py" line="60"/>
        <source>baud rate</source>
        <translation>rychlost linky</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>finding</source>
        <translation>zjištění</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>held</source>
        <translation>držen</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>Held still</source>
        <translation>Držen v klidu</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="53"/>
        <source>relay</source>
        <translation>přenos</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="53"/>
        <source>Farthest unlock, extender on</source>
        <translation>Nejvzdálenější odemčení, extender zapnut</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="53"/>
        <source>Unlocked beyond the border</source>
        <translation>Odemčeno za hranicí</translation>
    </message>
    <message>
        <location filename="../texts/keys/relay.py" line="53"/>
        <source>Stayed locked, extender on</source>
        <translation>Zůstalo zamčeno, extender zapnut</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>sleep_time</source>
        <translation>doba do usnutí</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>phone_error</source>
        <translation>chyba telefonu</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>relay_probability</source>
        <translation>pravděpodobnost přenosu</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>robot&apos;s clock ahead of the laptop&apos;s by</source>
        <translation>hodiny robotu jdou před hodinami notebooku o</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>front of the Car</source>
        <translation>předek auta</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>rear of the Car</source>
        <translation>záď auta</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>left of the Car</source>
        <translation>levý bok auta</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>right of the Car</source>
        <translation>pravý bok auta</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>wider intervals</source>
        <translation>širší intervaly</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>ignition</source>
        <translation>zapalování</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>gear</source>
        <translation>řazení</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>speed</source>
        <translation>rychlost</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>door</source>
        <translation>dveře</translation>
    </message>
    <message>
        <location filename="../texts/words.py" line="7"/>
        <source>coverage</source>
        <translation>pokrytí</translation>
    </message>
</context>
</TS>
